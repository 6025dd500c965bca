"""Checks results and figures against the present options, sources and packages: `make audit`, and without
rendering `make status`.

Results and figures must be unmodified and current, and a figure that is rendered again must have equal bytes.
A panel without figure files is not made: some of its results may exist, as other panels plot them.

Exit status: 0, 1 if something is stale, edited or missing, 3 if something could not be checked or nothing is
made.
"""

import os
import shutil
import subprocess
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from shlex import quote

from workflow.lib.identity import panel_of, run_of, sha256
from workflow.pipeline.plan import PYTHON, Panel, Plan, runs_of, warnings_of
from workflow.pipeline.state import (
    Fault,
    State,
    faults_of_files,
    faults_of_results,
    is_made,
)


def faults_of_rendering(panels: Iterable[Panel]) -> list[Fault]:
    """Renders panels again, in a temporary folder, which stays if there are faults."""
    folder = tempfile.mkdtemp(prefix="audit-")

    def fault(panel: Panel) -> Fault | None:
        again = f"{folder}/{panel.quality}/{panel.name}"
        command = [PYTHON, "-m", "workflow.render"]
        done = subprocess.run(command, input=panel.job(again), capture_output=True, text=True, check=False)
        if done.returncode:
            reason = f"rendering fails: {(done.stderr.splitlines() or ['?'])[-1]}"
            return Fault(State.NOT_CHECKED, panel.files[0], reason)
        return fault_of_bytes(panel, again)

    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as threads:
        faults = [*filter(None, threads.map(fault, panels))]
    if not faults:
        shutil.rmtree(folder)
    return faults


def fault_of_bytes(panel: Panel, again: str) -> Fault | None:
    """again: stem of the files that were rendered again."""
    for suffix, digest in panel.record["files"].items():
        path, rendered = f"{panel.stem}.{suffix}", Path(f"{again}.{suffix}")
        if sha256(rendered.read_bytes()) != digest:
            from workflow.render.save import renderer  # noqa: PLC0415  0.5 s, for matplotlib

            if (former := panel.record["renderer"]) != (here := renderer()):
                return Fault(State.NOT_CHECKED, path, f"rendered with {former}, this is {here}")
            if '"second"' in Path(f"{panel.stem}.csv").read_text():  # a unit of its table
                reason = f"it has CPU times, which may be others now: compare {rendered}"
                return Fault(State.NOT_CHECKED, path, reason)
            return Fault(State.EDITED, path, f"rendering it again gives other bytes: compare {rendered}")
    return None


def print_warnings(warnings: Mapping[str, list[str]]) -> None:
    """Prints a line for each panel and warning, with the runs."""
    alike = defaultdict(list)
    for path, reasons in warnings.items():
        alike[panel_of(path), "; ".join(reasons)].append(run_of(path))
    for (panel, reason), runs in alike.items():
        print(f"warning: {panel}: {reason}: {', '.join(runs)}")


def print_faults(faults: Iterable[Fault]) -> None:
    """Prints one line for all files of a folder with equal state and reason."""
    alike = defaultdict(list)
    for fault in faults:
        alike[fault.state, fault.reason, os.path.dirname(fault.path)].append(fault.path)
    for (state, reason, _), (first, *more) in alike.items():
        print(f"{state}: {first}{f' and {len(more)} more' if more else ''}: {reason}")


def audit(plan: Plan, names: Sequence[str], *, render: bool) -> int:
    """names: of the panels to check; all and the report if there are none. Returns the exit status."""
    requested = [plan[name] for name in names] or [*plan]
    made = [panel for panel in requested if is_made(panel)]
    reports = [plan.report] if plan.report and not names else []
    unmade = [product for product in [*requested, *reports] if not is_made(product)]
    plotted = runs_of(made)
    unplotted = {path: run for path, run in runs_of(requested).items() if path not in plotted}
    results, files = faults_of_results(plotted), faults_of_files([*made, *filter(is_made, reports)])
    faults = [*results.values(), *files.values()]
    if render:  # figures whose results and files hold
        faults += faults_of_rendering(
            panel for panel in made if panel.name not in files and not {*results} & {*panel.parents}
        )
    # Of panels without pictures, results that are missing are no fault.
    faults += [fault for fault in faults_of_results(unplotted).values() if fault.state is not State.MISSING]
    print_faults(faults)
    print_warnings(warnings_of(made))
    if unmade:
        print(f"Not made at quality {plan.quality.name}: {', '.join(product.name for product in unmade)}")
    states = Counter(fault.state for fault in faults)
    listed = ", ".join(f"{number} {state}" for state, number in states.items()) or "all hold"
    if made:
        print(f"{len(made)} panel{'s' if len(made) > 1 else ''} with {len(plotted)} results: {listed}")
    if states.keys() & {State.STALE, State.MISSING}:
        faulty = {*files, *(panel.name for panel in made if {*results} & {*panel.parents})}
        shipped = {product.name for product in [*plan.reported, *reports]}
        by_name = names or sorted(faulty - shipped)
        targets = [f"panel PANEL={quote(' '.join(by_name))}"] if by_name else []
        if not names and (faulty & shipped or not by_name):
            targets.append("report" if plan.report else "figures")
        for target in targets:
            print(f"make {target} {plan.quality.arguments} makes stale and missing files")
    if states.keys() - {State.NOT_CHECKED}:
        return 1
    return 3 if states or not made else 0

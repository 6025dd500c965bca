"""Checks results and figures against the present options, sources and packages: `make audit`, and without
rendering `make status`.

Results and figures must be unmodified and current, and a figure that is rendered again must have equal bytes.
A panel without figure files is not made: some of its results may exist, as other panels plot them.

Exit status: 0, 1 if something is stale, edited or missing, 3 if something could not be checked or nothing is
made.
"""

import os
import subprocess
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from pathlib import Path
from shlex import quote
from typing import NamedTuple

from workflow.lib.identity import ROOT, panel_of, run_of, sha256, siblings
from workflow.lib.load import FormatError, load_provenance
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import Panel, Plan, Run, doubtful, runs_of
from workflow.pipeline.sources import sources_changed
from workflow.render.files import format_os_error
from workflow.render.record import read_record

TOO_SHORT = ("accuracy",)  # panels with runs that are too short on purpose
WRITABLE = os.access(ROOT, os.W_OK)


class Fault(NamedTuple):
    state: str  # stale, edited, missing or not checked
    path: str
    reason: str


def options_of(words: str) -> list[str]:
    """Options, each with its value, from the words of a command line."""
    return [f"--{option.strip()}" for option in words.split("--")[1:]]


def hash_if_readable(path: str) -> str:
    """sha256 of a file; empty if it cannot be read."""
    try:
        return sha256(Path(path).read_bytes())
    except OSError:
        return ""


@cache
def tracked() -> set[str]:
    """Paths of the results in git, those of the release; all of data/paper if git does not answer, as in an
    archive."""
    with suppress(OSError, subprocess.CalledProcessError):
        command = ["git", "--git-dir=.git", "ls-files", "data"]
        return {*subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()}
    return {*map(str, Path("data/paper").rglob("*"))}


def fault_of_result(path: str, run: Run) -> Fault | None:
    """Fault of the result of a run. path: the planned one."""
    try:
        load_provenance(path)
    except OSError as error:
        return Fault("not checked", path, format_os_error(error))
    except FormatError as error:
        if Path(path).exists():
            return Fault("edited", path, str(error).removeprefix(path).strip(": "))
        former = [(differences_of_result(run, sibling), str(sibling)) for sibling in siblings(path)]
        if not former:
            return Fault("missing", path, "it is not there")
        differing, nearest = min(former, key=lambda pair: len(pair[0]))
        return Fault(
            "stale", nearest, ", ".join(differing) + "; it is of the release" * (nearest in tracked())
        )
    return None


def faults_of_results(runs: Mapping[str, Run]) -> dict[str, Fault]:
    """Faults by the planned paths."""
    return {path: fault for path, run in runs.items() if (fault := fault_of_result(path, run))}


def edited(panels: Iterable[Panel]) -> Iterator[Fault]:
    """Files of panels, and results that they plot, that were edited since the panel was made."""
    for panel in panels:
        yield from filter(None, [fault_of_files(panel)])
        for path, digest in panel.record.get("parents", {}).items():
            if path.endswith(".h5") and hash_if_readable(path) not in (digest, ""):
                yield Fault("edited", path, f"it differs from what {panel.name} plots; remove it")


def differences_of_result(run: Run, sibling: Path) -> list[str]:
    """Options and sources that differ between a run and a former result."""
    try:
        former = load_provenance(sibling)
    except (FormatError, OSError) as error:
        return [str(error)]
    was, now = options_of(former["option_words"]), options_of(run.options_text)
    differing = [f"it has {option}" for option in was if option not in now]
    differing += [f"planned is {option}" for option in now if option not in was]
    if sources_changed(former):
        differing.append(f"sources of {run.program} have changed")
    return differing


def is_made(panel: Panel) -> bool:
    """Whether there is a file of it, also of a former one."""
    return Path(panel.files[0]).exists() or bool(siblings(panel.record_path))


def fault_of_files(panel: Panel) -> Fault | None:
    """Fault of the files of a panel, the first of which stands for all."""
    record, path = panel.record, panel.record_path
    if not record and Path(path).exists():
        return Fault("edited", path, "it is damaged; remove it")
    if not record:
        former = next(filter(None, map(read_record, siblings(path))), None)
        if former is None:
            return Fault("missing", path, "it is not there")
        return Fault("stale", panel.files[0], differences(panel, former["parents"]))
    for suffix, digest in record["files"].items():
        file = f"{panel.stem}.{suffix}"
        if not Path(file).exists():
            return Fault("missing", file, "it is not there")
        if hash_if_readable(file) != digest:
            return Fault("edited", file, f"it differs from its hash in {path}; remove it")
    return None


def differences(panel: Panel, former: Mapping[str, str]) -> str:
    """What differs from the parents of a former record: sources by their paths; results or figures."""
    sources = panel.sources
    made = {path for path in former if path.startswith(("data/", "figures/")) and path not in sources}
    paths = dict.fromkeys([*sources, *(path for path in former if path not in made)])
    differing = [path for path in paths if sources.get(path) != former.get(path)]
    return f"changed: {', '.join(differing + ['results'] * (made != {*panel.parents}))}"


def faults_of_rendering(panels: Iterable[Panel]) -> Iterator[Fault]:
    """Renders panels again, in build/audit, of a read-only project in a temporary folder, where files stay
    that differ."""
    folder = "build/audit" if WRITABLE else tempfile.mkdtemp()

    def fault(panel: Panel) -> Fault | None:
        again = f"{folder}/{panel.selection}/{panel.name}"
        done = subprocess.run(panel.command(again), capture_output=True, text=True, check=False)
        if done.returncode:
            return Fault(
                "not checked", panel.files[0], f"rendering fails: {(done.stderr.splitlines() or ['?'])[-1]}"
            )
        return fault_of_bytes(panel, again)

    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as threads:
        yield from filter(None, threads.map(fault, panels))


def fault_of_bytes(panel: Panel, again: str) -> Fault | None:
    """again: stem of the files that were rendered again."""
    for suffix, digest in panel.record["files"].items():
        path, rendered = f"{panel.stem}.{suffix}", f"{again}.{suffix}"
        if hash_if_readable(rendered) != digest:
            from workflow.render.save import renderer  # noqa: PLC0415  0.5 s, for matplotlib

            if (former := panel.record["renderer"]) != (here := renderer()):
                return Fault("not checked", path, f"rendered with {former}, this is {here}")
            return Fault("edited", path, f"rendering it again gives other bytes: compare {rendered}")
        Path(rendered).unlink()
    return None


def check(panels: Sequence[Panel], render: bool) -> Iterator[Fault]:
    """Faults of the figures of panels and of the results that they plot. A figure whose results or files do
    not hold is not rendered."""
    plotted = {path: digest for panel in panels for path, digest in panel.record.get("parents", {}).items()}
    # A result that has the bytes of when it was plotted was checked then; to check all values takes ten times
    # as long.
    unknown = {
        path: run for path, run in runs_of(panels).items() if plotted.get(path) != hash_if_readable(path)
    }
    results = faults_of_results(unknown)
    files = {panel.name: fault for panel in panels if (fault := fault_of_files(panel))}
    yield from [*results.values(), *files.values()]
    if render:
        usable = (panel for panel in panels if panel.name not in files and not {*results} & {*panel.parents})
        yield from faults_of_rendering(usable)


def print_doubts(doubts: Mapping[str, list[str]]) -> None:
    """Names doubtful runs with the reasons, a line for each panel and reason."""
    alike = defaultdict(list)
    for path, reasons in doubts.items():
        alike[panel_of(path), "; ".join(reasons)].append(run_of(path))
    for (panel, reason), runs in sorted(alike.items(), key=lambda item: item[0][0] in TOO_SHORT):
        purpose = " (too short on purpose)" * (panel in TOO_SHORT)
        print(f"doubtful: {panel}{purpose}: {reason}: {', '.join(runs)}")


def audit(plan: Plan, names: Sequence[str], *, render: bool) -> int:
    """names: of the panels to check; all and the report if there are none. Returns the exit status."""
    if render and WRITABLE:
        lock_products()  # build/audit is one folder
    requested = [plan[name] for name in names] or [*plan]
    made = [panel for panel in requested if is_made(panel)]
    rest = [panel for panel in requested if panel not in made]
    plotted = runs_of(made)
    unplotted = {path: run for path, run in runs_of(rest).items() if path not in plotted}
    faults = [*check(made, render)]
    # Of panels without pictures, results that are missing are no fault.
    faults += [fault for fault in faults_of_results(unplotted).values() if fault.state != "missing"]
    alike = defaultdict(list)
    if not names and plan.report:
        if is_made(plan.report):
            faults += filter(None, [fault_of_files(plan.report)])
        else:
            rest.append(plan.report)
    for fault in faults:
        alike[fault.state, fault.reason, os.path.dirname(fault.path)].append(fault.path)
    for (state, reason, _), (first, *more) in alike.items():
        print(f"{state}: {first}{f' and {len(more)} more' if more else ''}: {reason}")
    print_doubts(doubtful(made))
    if rest:
        print(f"Not made at quality {plan.selection.name}: {', '.join(panel.name for panel in rest)}")
    states = Counter(fault.state for fault in faults)
    listed = ", ".join(f"{number} {state}" for state, number in states.items()) or "all hold"
    if made:
        print(f"{len(made)} panel{'s' * (len(made) > 1)} with {len(plotted)} results: {listed}")
    broken = states.keys() - {"not checked"}
    if broken & {"stale", "missing"}:
        target = f"panel PANEL={quote(' '.join(names))}" if names else "report"
        print(f"make {target} {plan.selection.arguments} makes stale and missing files")
    return 1 if broken else 3 if states or not made else 0

"""Makes what is missing by one call of Snakemake: results, panels, report, gallery."""

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from threading import Event, Thread

from workflow.lib.identity import panel_of
from workflow.pipeline.audit import TOO_SHORT, edited
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.environment import variables
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import Panel, Plan, doubtful, runs_of
from workflow.pipeline.program import compile_programs, require_built
from workflow.render.files import missing

LOG = Path("build/logs/snakemake.log")
SECONDS = 60  # between two lines of progress, if they do not go to a terminal
DONE = {  # of the targets of Snakemake
    "figures": "The figures are in figures/{selection}. Next: make report {arguments}",
    "panel": "In figures/{selection}: {panel}.pdf and .png .svg .csv",
    "report": "The report is figures/{selection}/report.html",
    "gallery": "The gallery is docs/gallery",
}


def make(target: str, selection: str, names: list[str], options: argparse.Namespace) -> int:
    """Makes what is missing of a target of DONE; with DRY=yes, lists it. names: of the panels of the target
    `panel`. After SEED and REPLICAS compares with the results of the quality. Returns the exit status. Raises
    ConfigurationError, BuildError, OSError, CalledProcessError."""

    def requested() -> tuple[Plan, list[Panel]]:
        plan = Plan(selection)
        return plan, [plan[name] for name in names] or (plan.paper if target == "figures" else [*plan])

    if options.dry:
        plan, panels = requested()
    else:
        lock_products()
        try:
            plan, panels = requested()
            complete = not missing(runs_of(panels))  # rendering needs no compiler
        except ConfigurationError:  # perhaps by former programs
            complete = False
        if not complete:
            compile_programs()
            plan, panels = requested()
    runs, products = runs_of(panels), [*panels, *[plan.report] * (target == "report")]
    results, files = missing(runs), missing(path for panel in products for path in panel.files)
    if options.dry:
        print("\n".join([*results, *files]) or "Nothing to be made")
        return 0
    for panel in (panel for panel in panels if names and panel.replaced):
        listed = ", ".join(panel.replaced)
        print(f"{panel.name}: other {listed} in quality/{plan.selection.quality}.yaml than in paper.yaml")
    if results or files or target == "gallery":
        for program in {runs[path].program for path in results}:
            require_built(program)
        unmade = [panel for panel in products if missing(panel.files)]
        with progress(unmade, results):
            targets = [*results, *files, *[target] * (target == "gallery")]
            status = snakemake(targets, selection, options)
        if variables.stopped:
            print("Stopped; the same command resumes", file=sys.stderr)
            return 128 + variables.stopped[0]
        if status:
            return report_failure(unmade)
    words = {"selection": selection, "arguments": plan.selection.arguments, "panel": " ".join(names)}
    print(DONE[target].format_map(words))
    report_defects(plan, panels)
    if target in ("figures", "panel") and plan.selection.name != plan.selection.quality:
        from workflow.pipeline.compare import compare  # noqa: PLC0415  0.5 s

        return compare(plan, [panel.name for panel in panels])
    return 0


def report_defects(plan: Plan, panels: Sequence[Panel]) -> None:
    """Prints files that were edited by hand, and the number of doubtful runs."""
    for fault in edited(panels):
        print(f"{fault.path}: {fault.reason}, then repeat the command", file=sys.stderr)
    if found := [path for path in doubtful(panels) if panel_of(path) not in TOO_SHORT]:
        number = f"{len(found)} run{'s have' if found[1:] else ' has'}"
        few = "; at smoke few replicas are intended" * (plan.selection.quality == "smoke")
        print(f"{number} doubts{few}: make status {plan.selection.arguments}")


def snakemake(targets: Sequence[str], selection: str, options: argparse.Namespace) -> int:
    """Makes what is missing of the targets. Returns the exit status. What Snakemake prints goes to LOG."""
    on_cluster = options.profile != "default"
    words = [f"--workflow-profile=profiles/{options.profile}"]
    words += [f"--{'jobs' if on_cluster else 'cores'}={options.jobs}"] if options.jobs else []
    slurm = {"slurm_account": options.account, "slurm_partition": options.partition}
    resources = [f"{name}={value}" for name, value in slurm.items() if value]
    words += ["--default-resources", *resources] if resources else []
    words += ["--config", f"quality={selection}", "--", *targets]
    from snakemake.cli import main as run  # noqa: PLC0415  0.5 s

    sys.argv = ["snakemake", *words]  # Snakemake prints its command
    LOG.parent.mkdir(parents=True, exist_ok=True)
    with LOG.open("w") as log, redirect_stderr(log), redirect_stdout(log):
        try:
            run(words)
        except SystemExit as end:
            if isinstance(end.code, str):
                print(end.code, file=log)
            return end.code if isinstance(end.code, int) else int(end.code is not None)
    return 0


@contextmanager
def progress(panels: Sequence[Panel], results: Sequence[str]) -> Iterator[None]:
    """Prints every panel that is made meanwhile, and how many results there are, in a terminal on one line."""
    output, done = sys.stdout, Event()

    def watch() -> None:
        pending, begin, printed = [*panels], time.monotonic(), time.monotonic()
        while pending:
            last = done.wait(1)
            for panel in [panel for panel in pending if not missing(panel.files)]:
                pending.remove(panel)
                print(f"{panel.name}: {printed_by(panel.log) or 'rendered'}", file=output, flush=True)
            made = len(results) - len(missing(results))
            minutes = (time.monotonic() - begin) / 60
            line = f"{made} of {len(results)} results after {minutes:.1f} minutes"
            if output.isatty():
                print(line, end=" \r", file=output, flush=True)
            elif results and time.monotonic() - printed > SECONDS:
                print(line, file=output, flush=True)
                printed = time.monotonic()
            if last:
                break

    watcher = Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()


def report_failure(unmade: Sequence[Panel]) -> int:
    """Prints a line for each panel that is not made, with the reason. Returns the exit status."""
    failed = [panel for panel in unmade if missing(panel.files)]
    for panel in failed:
        lacking = missing(panel.parents)
        logs = [path.removesuffix("h5") + "log" for path in lacking] or [panel.log]
        log = next((log for log in logs if printed_by(log)), str(LOG))
        reason = (printed_by(log) or "not made").splitlines()[-1]
        missed = "figures are missing" if panel.figures and lacking else f"{reason} ({log})"
        print(f"{panel.name}: {missed}", file=sys.stderr)
    print(f"{len(unmade) - len(failed)} other panels are made", file=sys.stderr)
    return 1


def printed_by(log: str) -> str:
    """What the command with this log has printed, "" if there is no log."""
    return Path(log).read_text().strip() if Path(log).exists() else ""

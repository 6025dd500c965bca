"""Makes what is missing by one call of Snakemake: results, panels, report, gallery."""

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
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
    `panel`. After an effort compares with the results of the quality. Returns the exit status. Raises
    ConfigurationError, BuildError, OSError, CalledProcessError."""
    if options.dry:
        plan = Plan(selection)
        panels = requested(plan, target, names)
    else:
        lock_products()
        plan, panels = with_programs(target, selection, names)
    unmade = [panel for panel in panels if panel.is_incomplete()]
    runs = runs_of(panels)
    results = missing(runs)
    if options.dry:
        print(
            "\n".join([*results, *(path for panel in unmade for path in panel.files)]) or "Nothing to be made"
        )
        return 0
    for panel in (panel for panel in panels if names and panel.replaced):
        listed = ", ".join(panel.replaced)
        print(f"{panel.name}: other {listed} in quality/{plan.selection.quality}.yaml than in paper.yaml")
    if unmade or target == "gallery":
        for program in {runs[path].program for path in results}:
            require_built(program)
        begin = time.time()
        with progress(unmade, results):
            status = snakemake(names or [target], selection, options)
        if variables.stopped:
            print("Stopped; the same command resumes", file=sys.stderr)
            return 128 + variables.stopped[0]
        if status:
            report_failure(panels, begin)
            return 1
    words = {"selection": selection, "arguments": plan.selection.arguments, "panel": " ".join(names)}
    print(DONE[target].format_map(words))
    report_defects(plan, panels)
    if target in ("figures", "panel") and plan.selection.effort:
        from workflow.pipeline.compare import compare  # noqa: PLC0415  0.5 s

        return compare(plan, [panel.name for panel in panels])
    return 0


def requested(plan: Plan, target: str, names: Sequence[str]) -> list[Panel]:
    """The panels of a target, for `report` with the report. Raises ConfigurationError."""
    if target in ("report", "gallery") and not plan.report:
        raise ConfigurationError("there is no folder workflow/study, which makes the report")
    if target == "report" and plan.report:
        return [*plan, plan.report]
    return [plan[name] for name in names] or (plan.paper if target == "figures" else [*plan])


def with_programs(target: str, selection: str, names: Sequence[str]) -> tuple[Plan, list[Panel]]:
    """Plan and panels of a target. Before, compiles the programs if results are missing: rendering needs no
    compiler. Raises ConfigurationError, CalledProcessError."""
    with suppress(ConfigurationError):  # perhaps by former programs
        plan = Plan(selection)
        panels = requested(plan, target, names)
        if not missing(runs_of(panels)):
            return plan, panels
    compile_programs()
    plan = Plan(selection)
    return plan, requested(plan, target, names)


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
        pending, begin, last = [*panels], time.monotonic(), time.monotonic()
        while pending:
            ended = done.wait(1)
            for panel in [panel for panel in pending if not panel.is_incomplete()]:
                pending.remove(panel)
                print(f"{panel.name}: {printed_by(panel.log) or 'rendered'}", file=output, flush=True)
            now, made = time.monotonic(), len(results) - len(missing(results))
            line = f"{made} of {len(results)} results after {(now - begin) / 60:.1f} minutes"
            if output.isatty():
                print(line, end=" \r", file=output, flush=True)
            elif results and now - last > SECONDS:
                print(line, file=output, flush=True)
                last = now
            if ended:
                break

    watcher = Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()


def report_failure(panels: Sequence[Panel], begin: float) -> None:
    """Prints a line for each panel that is not made, with the reason from a log that was written after a
    time."""
    failed, without = [panel for panel in panels if panel.is_incomplete()], []
    for panel in failed:
        logs = [path.removesuffix("h5") + "log" for path in missing(run.path for run in panel.plotted)]
        found = ((log, text) for log in [*logs, panel.log] if (text := printed_by(log, begin)))
        if first := next(found, None):
            print(f"{panel.name}: {first[1].splitlines()[-1]} ({first[0]})", file=sys.stderr)
        else:
            without.append(panel.name)
    if without:
        alone = len(without) == len(failed)  # otherwise Snakemake's last line is on the panels above
        reason = f": {printed_by(str(LOG)).splitlines()[-1]}" if alone else ""
        print(f"{', '.join(without)}: not made{reason} ({LOG})", file=sys.stderr)
    if made := len(panels) - len(failed):
        print(f"{made} other panel{'s are' if made > 1 else ' is'} made", file=sys.stderr)


def printed_by(log: str, begin: float = 0) -> str:
    """What the command with this log has printed after a time, "" if there is no such log."""
    path = Path(log)
    return path.read_text().strip() if path.exists() and path.stat().st_mtime >= begin else ""

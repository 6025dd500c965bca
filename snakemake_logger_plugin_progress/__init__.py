"""Progress of a workflow, from Snakemake's events: a bar, the running jobs, and a line per finished panel.

A logger plugin of Snakemake, selected by `logger: [progress]` in the profile. Snakemake's log is in .snakemake/log.
Its messages are printed with --dry-run, --verbose, --printshellcmds and --debug-dag, and if no job runs (--summary,
--report, --unlock, ...).
"""

import logging
import re
import shlex
import signal
import sys
import time
from contextlib import suppress
from datetime import timedelta
from pathlib import Path
from typing import Any

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from workflow.cluster.cost import DRAWING, estimated_seconds
from workflow.lib.command import counted
from workflow.lib.plan import data_path, load_plan, with_used

Record = Any  # a logging.LogRecord with the fields of its event

LAST = 12  # printed lines of the log of a failed job
TARGETS = (
    "figures",
    "panel",
    "report",
    "gallery",
    "crate",
    "tradeoff",
    "total",
)  # not jobs, though counted with them
INTERRUPTED = ("interrupted after", "KeyboardInterrupt")  # in the log of a program and of a script
STOPPING = ("Terminating processes on user request", "Will exit after finishing", "Cancelling snakemake")


class LogHandler(LogHandlerBase):
    writes_to_file = False
    has_filter = False  # use the filter of Snakemake, which implements --quiet
    has_formatter = False
    needs_rulegraph = False

    @property
    def writes_to_stream(self) -> bool:
        output = self.common_settings
        return not (output.dryrun or output.verbose or output.debug_dag or output.printshellcmds)

    def __post_init__(self) -> None:
        self._console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
        self._live = Live(self, console=self._console, transient=True)
        self._early: list[str] = []  # messages until the workflow starts
        self._command = ""
        self._total = self._runs = 0  # numbers of jobs
        self._paper = self._extensions = 0  # panels that are not rendered yet
        self._running: dict[int, Record] = {}  # JOB_INFO by number
        self._finished: set[str] = set()
        self._failed: dict[str, str] = {}  # with what is printed at the end
        # Jobs ended by a signal: by Ctrl-C, or by the cluster, which restarts them.
        self._interrupted: set[str] = set()
        self._stopped = False  # by Ctrl-C
        self._cores = 0  # 0 on a cluster, where the remaining time depends on the queue
        self._costs: dict[str, float] = {}  # estimated CPU seconds by panel/run, 0 if unknown
        self._unknown = 0  # runs of unknown cost
        self._waiting: list[float] = []  # estimated CPU seconds of runs that have not started
        self._estimated = self._taken = 0.0  # CPU seconds of finished jobs

    def emit(self, record: Record) -> None:
        if self.writes_to_stream:
            with suppress(OSError):  # a full or closed stdout does not stop the jobs
                self._show(record, getattr(record, "event", None))

    def _show(self, record: Record, event: LogEvent | None) -> None:
        if event == LogEvent.WORKFLOW_STARTED:
            self._command, self._early = record.cmd, []
        elif not self._command:
            self._early.append(self.format(record))
        elif event == LogEvent.RESOURCES_INFO:
            self._cores = getattr(record, "cores", self._cores)
        elif event == LogEvent.RUN_INFO:
            self._total = sum(number for rule, number in record.stats.items() if rule not in TARGETS)
            self._runs = record.stats.get("simulate", 0)
            self._paper = record.stats.get("draw", 0)
            self._extensions = record.stats.get("draw_extension", 0)
            if self._console.is_terminal:
                self._live.start()
        elif event == LogEvent.JOB_INFO and record.rule_name not in TARGETS:
            self._start(record)
        elif event == LogEvent.JOB_FINISHED and record.job_id in self._running:
            self._finish(self._running.pop(record.job_id))
        elif event == LogEvent.JOB_ERROR and record.jobid in self._running:
            self._fail(self._running.pop(record.jobid), record.log)
        elif event in (None, LogEvent.ERROR):
            self._message(record.getMessage(), record.levelno)

    def _start(self, job: Record) -> None:
        if not self._costs:
            self._estimate()
        if job.rule_name == "simulate":
            del self._waiting[:1]
        self._failed.pop(name_of(job), None)  # a retry
        self._interrupted.discard(name_of(job))
        self._running[job.jobid] = job

    def _estimate(self) -> None:
        """Assumes which runs wait, as events state only their number: those without a result, then the longest."""
        given = dict(word.partition("=")[::2] for word in shlex.split(self._command))
        quality = given.get("quality", "standard")
        plan = load_plan(quality)
        panels = [panel for name in given.get("panel", "").split() or plan for panel in with_used(plan, name)]
        runs = {f"{one.name}/{run.name}": (one.name, run) for one in panels for run in one.runs}
        estimated = {name: estimated_seconds(*run) for name, run in runs.items()}
        self._unknown = sum(seconds is None for seconds in estimated.values())
        self._costs = {name: seconds or 0.0 for name, seconds in estimated.items()}
        paths = {name: Path(data_path(quality, *run)) for name, run in runs.items()}
        made = {name for name, path in paths.items() if path.exists()}
        order = sorted(runs, key=lambda name: (name in made, -self._costs[name]))
        self._waiting = [self._costs[name] for name in order][: self._runs]

    def _finish(self, job: Record) -> None:
        name = name_of(job)
        self._finished.add(name)
        self._estimated += self._cost(job)
        self._taken += elapsed(job) * job.threads
        if job.rule_name.startswith("draw"):
            self._console.print(f"{name}: rendered from {counted(len(job.input), 'run')}, {self._state}")
            self._paper -= job.rule_name == "draw"
            if job.rule_name == "draw" and not self._paper and self._extensions:
                self._console.print(
                    f"The paper's figures are in figures/{job.wildcards['quality']}; extensions follow"
                )
        elif job.rule_name in ("simulate", "join", "single"):
            value, doubts = outcome(Path(job.output[0]))
            if self._console.is_terminal or doubts:
                self._console.print(f"{name}: {', '.join([value, *doubts])}, {self._state}")

    def _fail(self, job: Record, logs: list[str]) -> None:
        if any(mark in line for line in last_lines(logs[0]) for mark in INTERRUPTED):
            self._interrupted.add(name_of(job))
            # Without a cluster the signal is Ctrl-C, of which Snakemake reports later.
            self._stopped = self._stopped or bool(self._cores)
        elif not self._stopped:
            log, lines = next(((log, lines) for log in logs if (lines := last_lines(log))), (logs[0], []))
            heading = f"{name_of(job)} failed after {clock(elapsed(job))}. {log}"
            if lines:
                self._console.print("\n  ".join([f"{heading} ends with:", *lines]))
                self._failed[name_of(job)] = ""
            else:  # perhaps by Ctrl-C, of which Snakemake reports later
                self._failed[name_of(job)] = f"{heading} is empty: the job was killed, or did not start"

    def _message(self, text: str, level: int) -> None:
        """Prints errors, except those that follow from a failed job or from Ctrl-C."""
        self._stopped = self._stopped or text.startswith(STOPPING)
        if self._stopped:
            ignore_interrupts()
        # JOB_ERROR comes after CalledProcessError.
        follows = self._stopped or self._failed or self._interrupted or "CalledProcessError" in text
        if text.startswith("Nothing to be done") or (level >= logging.ERROR and not follows):
            self._console.print(text)

    def close(self) -> None:
        if self._stopped:
            ignore_interrupts()  # Snakemake has its own handler meanwhile
        self._live.stop()
        sys.stderr.writelines(f"{text}\n" for text in self._early)
        done = f"{len(self._finished)} of {self._total} done"
        forced = re.search(r" (--forceall|-F)\b", self._command)
        advice = "starts again; without FRESH=yes it resumes" if forced else "resumes"
        if self._stopped:
            self._failed = {name: end for name, end in self._failed.items() if not end}
        with suppress(OSError):
            for end in filter(None, self._failed.values()):
                self._console.print(end)
            if self._failed:
                self._console.print(
                    f"Failed: {', '.join(self._failed)}; {done}. Fix the cause; the same command {advice}."
                )
            elif self._stopped or self._interrupted:
                self._console.print(f"Stopped: {done}. The same command {advice}.")
        # Python closes all handlers again at exit.
        self._early, self._failed, self._interrupted, self._stopped = [], {}, set(), False
        super().close()

    @property
    def _state(self) -> str:
        """12 of 37 done, about 0:00:20 left."""
        done = f"{len(self._finished)} of {self._total} done"
        if not self._cores or len(self._finished) >= self._total:
            return done
        running = [*self._running.values()]
        drawings = self._total - len(self._finished) - len(running) - len(self._waiting)
        costs = sum(self._waiting) + drawings * DRAWING + sum(map(self._cost, running))
        speed = self._taken / self._estimated if self._estimated else 1.0
        left = speed * costs - sum(elapsed(job) * job.threads for job in running)
        more = " and runs of unknown cost" if self._unknown else ""
        return f"{done}, about {clock(max(left, 0.0) / self._cores)}{more} left"

    def _cost(self, job: Record) -> float:
        return self._costs.get(name_of(job), DRAWING)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        table = Table.grid(padding=(0, 2))
        table.add_row(ProgressBar(self._total, len(self._finished), width=30), self._state)
        yield table
        for job in [*self._running.values()]:
            line = f"  {name_of(job)}  {clock(elapsed(job))}  {' '.join(last_lines(job.log[0])[-1:])}"
            yield Text(line, overflow="ellipsis", no_wrap=True)


def outcome(path: Path) -> tuple[str, list[str]]:
    """Value `mu = 0.3289(30)`, or the error of an array; and the marks of the result."""
    from workflow.lib.fit import with_error  # noqa: PLC0415  0.5 s
    from workflow.lib.load import NOT_TESTED, load  # noqa: PLC0415

    result = load(path)
    name = result.provenance["target_quantity"]
    # Programs without a test of stationarity would print this for every run.
    doubts = [doubt for doubt in result.doubts if doubt != NOT_TESTED or "stationary" in result.quantities]
    quantity = result.quantities.get(name)
    if quantity is None or quantity.mean.size > 1:
        return f"error of {name} {float(result.provenance['achieved_error']):.2g}", doubts
    error = quantity.error if quantity.discretisation_error is None else quantity.discretisation_error
    return f"{name} = {with_error(float(quantity.mean), float(error))}", doubts


def name_of(job: Record) -> str:
    """`panel`, `panel/run` or `panel/run/replicas`, or the rule of another product."""
    parts = [job.wildcards[key] for key in ("panel", "run", "part") if key in job.wildcards]
    return "/".join(parts) or job.rule_name


def ignore_interrupts() -> None:
    """A second Ctrl-C would end in a traceback."""
    with suppress(ValueError):  # not in the main thread
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def elapsed(job: Record) -> float:
    return time.time() - float(job.created)


def clock(seconds: float) -> str:
    return str(timedelta(seconds=round(seconds)))


def last_lines(log: str) -> list[str]:
    """Last lines of a log; empty if it is missing."""
    with suppress(OSError):
        return Path(log).read_text(errors="replace").splitlines()[-LAST:]
    return []

"""Progress of a workflow, from Snakemake's events: a bar, the running jobs, and a line per finished panel.

A logger plugin of Snakemake, chosen by `logger: [progress]` in the profile. Snakemake's own log is in .snakemake/log. Where more is
requested (--dry-run, --verbose, --printshellcmds, --debug-dag) and where no job runs (--summary, --report, --unlock, ...),
Snakemake's own messages are shown.
"""

import logging
import re
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

from snakemake_logger_plugin_progress.estimates import Remaining, outcome

Record = Any  # a logging.LogRecord with the fields of its event

LAST = 12  # lines of the log of a failed job
STOPPING = ("Terminating processes on user request", "Will exit after finishing", "Cancelling snakemake")


class LogHandler(LogHandlerBase):
    writes_to_file = False
    has_filter = False  # Snakemake's, which obeys --quiet
    has_formatter = False
    needs_rulegraph = False

    @property
    def writes_to_stream(self) -> bool:
        requested = self.common_settings
        return not (requested.dryrun or requested.verbose or requested.debug_dag or requested.printshellcmds)

    def __post_init__(self) -> None:
        self._console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
        self._live = Live(self, console=self._console, transient=True)
        self._early: list[str] = []  # messages until the workflow starts
        self._command = ""
        self._cores = self._total = 0
        self._remaining: Remaining | None = None
        self._running: dict[int, Record] = {}  # JOB_INFO by number
        self._finished: set[str] = set()
        self._failed: dict[str, None] = {}  # in their order
        self._notes: list[str] = []
        self._stopped = False

    def emit(self, record: Record) -> None:
        if self.writes_to_stream:
            with suppress(OSError):  # stdout is full or closed: the jobs go on
                self._show(record, getattr(record, "event", None))

    def _show(self, record: Record, event: LogEvent | None) -> None:
        if event == LogEvent.WORKFLOW_STARTED:
            self._command, self._early = record.cmd, []
        elif not self._command:
            self._early.append(self.format(record))
        elif event == LogEvent.RESOURCES_INFO:
            self._cores = getattr(record, "cores", self._cores)
        elif event == LogEvent.RUN_INFO:
            self._begin(record.stats)
        elif event == LogEvent.JOB_INFO and record.wildcards:  # the target has none
            self._failed.pop(name_of(record), None)  # a retry
            self._running[record.jobid] = record
            if self._remaining:
                self._remaining.start(name_of(record), record.wildcards["quality"])
        elif event == LogEvent.JOB_FINISHED and record.job_id in self._running:
            self._finish(self._running.pop(record.job_id))
        elif event == LogEvent.JOB_ERROR and record.jobid in self._running:
            self._fail(self._running.pop(record.jobid), record.log)
        elif event in (None, LogEvent.ERROR):
            self._message(record.getMessage(), record.levelno)

    def _begin(self, jobs: dict[str, int]) -> None:
        """jobs: their number by rule."""
        runs, drawings = jobs.get("simulate", 0), jobs.get("draw", 0)
        self._total = sum(jobs.get(rule, 0) for rule in ("simulate", "draw", "part", "join"))
        if runs + drawings == self._total:  # not on a cluster, where the time left depends on the queue
            self._remaining = Remaining(
                runs, drawings, self._cores, re.search(r"\bpanel=(\S+)", self._command)
            )
        if self._console.is_terminal:
            self._live.start()

    def _finish(self, job: Record) -> None:
        name = name_of(job)
        self._finished.add(name)
        if self._remaining:
            self._remaining.finish(name, elapsed(job) * job.threads)
        if job.rule_name == "draw":
            runs = len(job.input)
            self._console.print(f"{name}: drawn from {runs} run{'s' if runs > 1 else ''}, {self._state}")
        elif job.rule_name != "part":
            value, doubts = outcome(Path(job.output[0]))
            self._notes += [f"{name}: {doubt}: marked in the figure" for doubt in doubts]
            if self._console.is_terminal:
                self._console.print(f"{name}: {', '.join([value, *doubts])}, {self._state}")

    def _fail(self, job: Record, logs: list[str]) -> None:
        if not self._stopped:
            name = name_of(job)
            self._failed[name] = None
            log = next((log for log in logs if last_lines(log)), logs[0])
            ending = "ends with:" if last_lines(log) else "is empty: the job was killed, or did not start"
            heading = f"{name} failed after {clock(elapsed(job))}. {log} {ending}"
            self._console.print("\n  ".join([heading, *last_lines(log)]))

    def _message(self, text: str, level: int) -> None:
        """Errors, but for those that follow from a failed job or from Ctrl-C."""
        self._stopped = self._stopped or text.startswith(STOPPING)
        follows = self._stopped or self._failed or "CalledProcessError" in text  # JOB_ERROR comes next
        if text.startswith("Nothing to be done") or (level >= logging.WARNING and not follows):
            self._console.print(text)

    def close(self) -> None:
        self._live.stop()
        for text in self._early:
            print(text, file=sys.stderr)
        with suppress(OSError):
            for text in [*self._notes, *self._ending()]:
                self._console.print(text)
        self._early, self._notes, self._command = [], [], ""
        super().close()

    def _ending(self) -> list[str]:
        if not self._command or not (self._failed or self._stopped):
            return []
        count = f"{len(self._finished)} of {self._total} done"
        if self._failed:
            return [
                f"Failed: {', '.join(self._failed)}; {count}. Fix the cause; the same command goes on with the rest."
            ]
        if re.search(r" (--forceall|-F)\b", self._command):
            return [
                f"Stopped: {count}. The same command starts again; without FRESH=yes it completes what was interrupted."
            ]
        return [f"Stopped: {count}. The same command goes on."]

    @property
    def _state(self) -> str:
        """12 of 37 done, about 0:00:20 left."""
        text = f"{len(self._finished)} of {self._total} done"
        if self._remaining is None or len(self._finished) >= self._total:
            return text
        spent = {name_of(job): elapsed(job) * job.threads for job in list(self._running.values())}
        return f"{text}, about {clock(self._remaining.seconds(spent))} left"

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        table = Table.grid(padding=(0, 2))
        table.add_row(ProgressBar(self._total, len(self._finished), width=30), self._state)
        yield table
        for job in list(self._running.values()):
            line = f"  {name_of(job)}  {clock(elapsed(job))}  {' '.join(last_lines(job.log[0])[-1:])}"
            yield Text(line, overflow="ellipsis", no_wrap=True)


def name_of(job: Record) -> str:
    """panel, panel/run or panel/run/replicas."""
    return "/".join(job.wildcards[key] for key in ("panel", "run", "part") if key in job.wildcards)


def elapsed(job: Record) -> float:
    return time.time() - float(job.created)


def clock(seconds: float) -> str:
    return str(timedelta(seconds=round(seconds)))


def last_lines(log: str) -> list[str]:
    """None of a log that is missing."""
    try:
        return Path(log).read_text(errors="replace").splitlines()[-LAST:]
    except OSError:
        return []

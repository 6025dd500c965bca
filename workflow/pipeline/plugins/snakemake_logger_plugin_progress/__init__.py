"""Progress from Snakemake's events: a line per panel, doubtful result and failure; on a terminal also a bar and the running jobs.

A logger plugin, selected by `logger: [progress]` in the profile. Snakemake's own messages are in .snakemake/log; they are
printed instead with --dry-run, --verbose, --printshellcmds and --debug-dag.
"""

import logging
import os
import time
from contextlib import suppress
from datetime import timedelta
from pathlib import Path
from typing import Any

from rich.console import Console, Group
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.text import Text
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

INTERRUPTED = ("interrupted after", "KeyboardInterrupt")  # in the log of a program and of a script
NOTE = "Not shown: "  # in the log of a script
STOPPING = ("Terminating processes on user request", "Will exit after finishing", "Cancelling snakemake")


class LogHandler(LogHandlerBase):
    writes_to_file = has_formatter = needs_rulegraph = False
    has_filter = False  # use the filter of Snakemake, which implements --quiet

    @property
    def writes_to_stream(self) -> bool:
        output = self.common_settings
        return not (output.dryrun or output.verbose or output.debug_dag or output.printshellcmds)

    def __post_init__(self) -> None:
        self._begin = time.monotonic()
        self._done = self._total = 0  # jobs
        self._running: dict[int, Any] = {}  # events JOB_INFO by number
        self._failed: list[str] = []
        self._group_logs: list[str] = []  # of the last group that failed
        self._stopped = False  # by Ctrl-C
        self._console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
        self._live = Live(console=self._console, get_renderable=self._screen, transient=True)

    def emit(self, record: Any) -> None:
        event = getattr(record, "event", None)
        if not self.writes_to_stream:
            return
        if event == LogEvent.RUN_INFO:
            self._total = record.stats["total"]
            if self._console.is_terminal:
                self._live.start()
        elif event == LogEvent.JOB_INFO:
            self._running[record.jobid] = record
            self._failed = [name for name in self._failed if name != name_of(record)]  # a retry
        elif event == LogEvent.JOB_FINISHED and record.job_id in self._running:
            self._finish(self._running.pop(record.job_id))
        elif event == LogEvent.GROUP_ERROR:
            self._group_logs = record.aux_logs
        elif event == LogEvent.JOB_ERROR and record.jobid in self._running:
            self._fail(self._running.pop(record.jobid), record)
        elif event in (None, LogEvent.ERROR):
            text = record.getMessage()
            self._stopped = self._stopped or text.startswith(STOPPING)
            follows = self._stopped or self._failed or "CalledProcessError" in text  # from an event JOB_ERROR
            if text.startswith("Nothing to be done") or (record.levelno >= logging.ERROR and not follows):
                self._print(text)

    def _print(self, text: str) -> None:
        with suppress(OSError):  # a full or closed stdout does not stop the jobs
            self._console.print(text)

    def _finish(self, job: Any) -> None:
        from workflow.lib.load import NOT_TESTED, FormatError, load  # noqa: PLC0415  0.5 s

        self._done += 1
        found = []
        for path in (path for path in job.output if path.endswith(".h5")):
            try:
                found += [doubt for doubt in load(path).doubts if doubt != NOT_TESTED]
            except (FormatError, OSError) as error:  # an exception here would end the display
                found.append(str(error))
        if "panel" in job.wildcards and "run" not in job.wildcards:
            found += [line for line in last_lines(*job.log) if line.startswith(NOTE)]
            found.append("rendered")
        if found:
            self._print(f"{name_of(job)}: {', '.join(found)}; {self._state()}")

    def _fail(self, job: Any, record: Any) -> None:
        logs = [log for log in [*record.log, *self._group_logs] if last_lines(log)]
        log, lines = (logs[0], last_lines(logs[0])) if logs else ("its log", ["(empty)"])
        ended = any(mark in line for line in lines for mark in INTERRUPTED)
        finished = record.indent and all(map(os.path.exists, job.output))  # a group fails as a whole
        if not (self._stopped or ended or finished):
            self._failed.append(name_of(job))
            self._print("\n  ".join([f"{name_of(job)} failed. The end of {log}:", *lines]))

    def close(self) -> None:
        self._live.stop()
        if self._stopped or self._failed:
            end = f"Failed: {', '.join(self._failed)}" if self._failed else "Stopped"
            self._print(f"{end}; {self._state()}. Finished results are kept.")
        elif self._done:
            self._print(self._state())
        self._stopped, self._failed, self._done = False, [], 0  # Python closes all handlers again at exit
        super().close()

    def _state(self) -> str:
        elapsed = timedelta(seconds=int(time.monotonic() - self._begin))
        return f"{self._done} of {self._total} jobs done, elapsed {elapsed}"

    def _screen(self) -> Group:
        running = [*self._running.values()][:8]
        jobs = [f"  {name_of(job)}  {''.join(last_lines(*job.log)[-1:])}" for job in running]
        lines = [Text(line, overflow="ellipsis", no_wrap=True) for line in [self._state(), *jobs]]
        return Group(ProgressBar(self._total, self._done, width=40), *lines)


def name_of(job: Any) -> str:
    """`panel/run` or `panel`, or the rule of another product."""
    names = [job.wildcards[key] for key in ("panel", "run") if key in job.wildcards]
    return "/".join(names) or str(job.rule_name)


def last_lines(log: str = "") -> list[str]:
    """At most 12 lines; none if the log is missing."""
    with suppress(OSError):
        return Path(log).read_text(errors="replace").splitlines()[-12:]
    return []

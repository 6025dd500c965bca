"""What make figures and make panel show of Snakemake's events. Snakemake's own words go to its log in .snakemake/log."""

import logging
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from workflow.execution.display import Display, Running
from workflow.execution.outcome import last_lines, outcome
from workflow.execution.remaining import Remaining, foretold
from workflow.execution.stopping import stopping
from workflow.lib.plan import Panel, data_path

Record = Any  # a logging.LogRecord with what Snakemake adds to it, which depends on the event

OF_PROJECT = "of_project"  # attribute of the messages that the Snakefile writes itself

NOTHING = "Nothing to be done"  # so Snakemake


class LogHandler(LogHandlerBase):
    """A logger plugin of Snakemake's."""

    writes_to_stream = True
    writes_to_file = False
    has_filter = True
    has_formatter = True
    needs_rulegraph = False

    def __post_init__(self) -> None:
        self._display = Display()
        self._begun = False
        self._running: dict[int, Running] = {}

    def begin(self, quality: str, plan: Mapping[str, Panel], jobs: Iterable[str], cores: int) -> None:
        """jobs: those that will be made, `panel/run` or `panel`."""
        self._begun = True
        self._quality, self._plan = quality, plan
        costs = foretold(plan, jobs)
        self._display.begin(costs, Remaining(costs, cores))

    def emit(self, record: Record) -> None:
        event = getattr(record, "event", None)
        if event == LogEvent.JOB_INFO and self._begun:
            self._start(record)
        elif event == LogEvent.JOB_FINISHED and record.job_id in self._running:
            self._finish(self._running.pop(record.job_id))
        elif event == LogEvent.JOB_ERROR and self._begun:
            self._fail(record)
        elif self._is_message(record):
            self._display.say(record.getMessage())

    def _is_message(self, record: logging.LogRecord) -> bool:
        """The project's own, that there is nothing to do, and what goes wrong but for what follows from a job that failed or from
        Ctrl-C."""
        if getattr(record, OF_PROJECT, False) or record.getMessage().startswith(NOTHING):
            return True
        wrong = getattr(record, "event", None) in (None, LogEvent.ERROR) and record.levelno >= logging.WARNING
        return wrong and not self._display.failing and not stopping.is_set()

    def _start(self, record: Record) -> None:
        if record.wildcards:  # the target has none
            job = "/".join(record.wildcards[name] for name in ("panel", "run") if name in record.wildcards)
            part = record.wildcards.get("part", "")
            running = Running(job, time.monotonic(), record.threads, Path(record.log[0]), part)
            self._running[record.jobid] = running
            self._display.start(running)

    def _finish(self, running: Running) -> None:
        panel, _, run = running.job.partition("/")
        if running.part:
            self._display.finish_part(running)
        elif run:
            self._display.finish_run(running, outcome(Path(data_path(self._quality, panel, run))))
        else:
            self._display.finish_panel(running, len(self._plan[panel].runs))

    def _fail(self, record: Record) -> None:
        running = self._running.pop(record.jobid, None)
        if running and not stopping.is_set():
            self._display.fail(running, last_lines(running.log))

    def close(self) -> None:
        self._display.end()
        super().close()

"""On a terminal a bar, the jobs that run and a line per run; elsewhere a line per panel."""

import sys
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from workflow.execution.outcome import Outcome, last_lines
from workflow.execution.remaining import Remaining, clock

BAR = 30  # columns


@dataclass(frozen=True)
class Running:
    """job: `panel/run` or `panel`. start: by the monotonic clock. part: the replicas that are measured, if not all."""

    job: str
    start: float
    threads: int
    log: Path
    part: str = ""

    @property
    def name(self) -> str:
        return f"{self.job}, replicas {self.part}" if self.part else self.job

    @property
    def elapsed(self) -> float:
        return time.monotonic() - self.start


class Display:
    def __init__(self) -> None:
        self._console = Console(file=sys.stdout, highlight=False, markup=False, emoji=False, soft_wrap=True)
        self._live = Live(self, console=self._console, auto_refresh=True, transient=True)
        self._remaining: Remaining | None = None
        self._running: dict[str, Running] = {}  # by name
        self._jobs: set[str] = set()  # foretold, or finished though they were not
        self._finished: set[str] = set()
        self._ended = False
        self._failed: dict[str, None] = {}  # names, in their order
        self._doubts: list[str] = []

    @property
    def failing(self) -> bool:
        return bool(self._failed)

    def say(self, text: str) -> None:
        """Nothing any more where the output is full or nobody reads it; the jobs go on, and make notices at its end."""
        try:
            self._console.print(text)
        except OSError:
            self._console = Console(quiet=True)

    def begin(self, jobs: Iterable[str], remaining: Remaining) -> None:
        self._jobs, self._remaining = set(jobs), remaining
        if self._console.is_terminal:
            self._live.start()

    def start(self, running: Running) -> None:
        """Perhaps once more, after it has failed."""
        self._failed.pop(running.name, None)
        self._running[running.name] = running

    def finish_run(self, running: Running, result: Outcome) -> None:
        self._finish(running)
        if result.doubts:
            self._doubts.append(f"{running.job}: {', '.join(result.doubts)}")
        if self._console.is_terminal:
            self.say(f"{running.job}: {result.text}{self._mark(result)}, {self.state}")

    def finish_part(self, running: Running) -> None:
        """The run is done when its parts are joined."""
        self._running.pop(running.name, None)

    def finish_panel(self, running: Running, runs: int) -> None:
        self._finish(running)
        drawn = f" from {runs} run{'s' if runs > 1 else ''}" if runs else ""
        self.say(f"{running.job}: drawn{drawn}, {self.state}")

    def fail(self, running: Running, lines: Sequence[str]) -> None:
        self._running.pop(running.name, None)
        self._failed[running.name] = None
        said = "ends with:" if lines else "is empty: it was killed, or never began"
        self.say(f"{running.name} failed after {clock(running.elapsed)}. {running.log} {said}")
        for line in lines:
            self.say(f"  {line}")

    def end(self) -> None:
        """What is to be known when nothing runs any more."""
        self._live.stop()
        if self._remaining is None or self._ended:
            return
        self._ended = True
        for doubt in self._doubts:
            self.say(f"{doubt}: marked in the figure")
        if self._failed:
            self.say(
                f"Failed: {', '.join(self._failed)}; {self._count}. When the cause is mended, the same "
                "command goes on with the rest."
            )
        elif self._finished < self._jobs:
            self.say(f"Stopped: {self._count}. The same command goes on.")

    @property
    def _count(self) -> str:
        return f"{len(self._finished)} of {len(self._jobs)} done"

    @property
    def state(self) -> str:
        """12 of 37 done, about 0:20 left."""
        assert self._remaining is not None
        left = self._remaining.seconds(
            {job: (one.elapsed, one.threads) for job, one in self._running.items()}
        )
        return self._count + (f", about {clock(left)} left" if self._finished < self._jobs else "")

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        table = Table.grid(padding=(0, 2))
        table.add_row(
            ProgressBar(total=len(self._jobs), completed=len(self._finished), width=BAR), self.state
        )
        yield table
        for one in list(self._running.values()):
            line = " ".join(last_lines(one.log)[-1:])
            yield Text(f"  {one.name}  {clock(one.elapsed)}  {line}", overflow="ellipsis", no_wrap=True)

    def _finish(self, running: Running) -> None:
        self._running.pop(running.name, None)
        self._jobs.add(running.job)
        self._finished.add(running.job)
        assert self._remaining is not None
        self._remaining.finish(running.job, running.elapsed * running.threads)

    @staticmethod
    def _mark(result: Outcome) -> str:
        return f" ({', '.join(result.doubts)})" if result.doubts else ""

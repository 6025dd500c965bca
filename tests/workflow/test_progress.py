"""Snakemake's display on a terminal and in a pipe, after a failure and after Ctrl-C."""

import os
import pty
import re
import select
import time

import pytest

from tests.workflow.conftest import Clone, replace

CONTROL = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]")


def on_a_terminal(
    clone: Clone, *arguments: str, until: str = "", times: int = 1, patience: float = 300
) -> tuple[str, float]:
    """The output, and the seconds from the last Ctrl-C, which is pressed when `until` has appeared, to the end."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(clone.folder)
        environment = {"PATH": os.defpath, "HOME": "/", "TERM": "xterm"}
        os.execve(".venv/bin/snakemake", ["snakemake", "--config", *arguments], environment)
    shown, pressed, end = "", 0.0, time.monotonic() + patience
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            try:
                shown += os.read(terminal, 65536).decode(errors="replace")
            except OSError:  # raised when the terminal is closed
                break
        if until and not pressed and re.search(until, shown):
            for _ in range(times):
                os.write(terminal, b"\x03")
                time.sleep(0.3)
            pressed = time.monotonic()
    os.waitpid(process, 0)
    os.close(terminal)
    return CONTROL.sub("", shown), time.monotonic() - pressed


def test_a_terminal_has_a_line_per_run(kept: Clone) -> None:
    shown, _ = on_a_terminal(kept, "quality=smoke", "panel=fig06", "--forceall", "--", "panel")
    assert re.search(r"fig06/all_sigma=0\.5: \w+ = \S+, \d of 3 done, about 0:\d\d:\d\d left", shown)
    assert "fig06: rendered from 2 runs, 3 of 3 done" in shown


def test_a_failure_shows_the_end_of_its_log_alone_and_keeps_the_pictures(kept: Clone) -> None:
    """The record is missing, so that they are rendered by the next command."""
    before = kept.products()
    replace(
        "workflow/figures/fig06.py", "    run(draw", '    raise RuntimeError("broken here")\n    run(draw'
    )(kept)
    _, first, *log, last = kept.snakemake("figures", status=1).splitlines()
    assert re.fullmatch(
        r"fig06 failed after 0:\d\d:\d\d\. build/logs/smoke/fig06\.[0-9a-f]{12}\.log ends with:", first
    )
    assert log[-1] == "  RuntimeError: broken here"
    assert last == "Failed: fig06; 0 of 1 done. Fix the cause; the same command resumes."
    assert kept.products() == before
    assert kept.stale() == {"fig06"}


@pytest.mark.parametrize("times", [1, 3])
def test_ctrl_c(kept: Clone, times: int) -> None:
    arguments = ("quality=standard", "panel=fig08", "--", "panel")
    shown, seconds = on_a_terminal(kept, *arguments, until=r"\d of \d+ done", times=times)
    assert re.search(r"Stopped: \d+ of \d+ done\..*The same command resumes", shown)
    assert "Traceback" not in shown
    assert seconds < 10

"""What make shows on a terminal and in a pipe, and how it stops."""

import os
import pty
import re
import select
import time

import pytest

from tests.workflow.conftest import Clone, append

CONTROL = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]")


def on_a_terminal(clone: Clone, *arguments: str, until: str = "", patience: float = 120) -> tuple[str, float]:
    """What is shown, and the seconds that make went on for after Ctrl-C, which is pressed when `until` has been shown."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(clone.folder)
        os.execve("/usr/bin/make", ["make", *arguments], {"PATH": os.defpath, "HOME": "/", "TERM": "xterm"})
    shown, pressed, end = "", 0.0, time.monotonic() + patience
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            try:
                shown += os.read(terminal, 65536).decode(errors="replace")
            except OSError:  # the end of the terminal
                break
        if until and not pressed and re.search(until, shown):
            os.write(terminal, b"\x03")
            pressed = time.monotonic()
    os.waitpid(process, 0)
    os.close(terminal)
    return CONTROL.sub("", shown), time.monotonic() - pressed


def test_a_pipe_has_a_line_per_panel(kept: Clone) -> None:
    append("workflow/figures/fig03.py", "# more\n")(kept)
    made = kept.make("figures", "QUALITY=smoke")
    said = [line for line in made.stdout.splitlines() if not line.startswith("Using workflow")]
    assert said == [
        "fig03 is stale: workflow/figures/fig03.py changed",
        "fig03: drawn from 3 runs, 1 of 1 done",
        "Figures are in figures/smoke",
        "Next: make report QUALITY=smoke judges the claims of the paper by them",
    ]


def test_a_terminal_has_a_line_per_run(kept: Clone) -> None:
    shown, _ = on_a_terminal(kept, "panel", "PANEL=fig05", "QUALITY=smoke", "FRESH=yes")
    assert re.search(
        r"fig05/paper_sigma=0\.5: mu = 0\.3\d+\(\d+\), \d+ of 37 done, about \d:\d\d left", shown
    )
    assert "fig05: drawn from 36 runs, 37 of 37 done" in shown


def test_the_end_of_the_log_that_matters_is_shown(kept: Clone) -> None:
    append("workflow/figures/fig03.py", 'raise RuntimeError("broken here")\n')(kept)
    made = kept.make("figures", "QUALITY=smoke")
    assert made.returncode == 2
    assert "fig03 failed after" in made.stdout
    assert "build/logs/smoke/fig03.log ends with:\n" in made.stdout
    assert made.stdout.count("broken here") == 2  # the line of the source and the message
    assert "Failed: fig03; 0 of 1 done. When the cause is mended" in made.stdout


@pytest.mark.parametrize(
    ("moment", "words"),
    [
        ("Using workflow", "Stopped.*The same command goes on"),
        ("0 of 24 done", r"Stopped: \d+ of 24 done\. The same command goes on"),
    ],
    ids=["start", "run"],
)
def test_interrupted(kept: Clone, moment: str, words: str) -> None:
    arguments = ("panel", "PANEL=fig08", "QUALITY=standard")
    shown, seconds = on_a_terminal(kept, *arguments, until=moment)
    assert re.search(words, shown)
    assert "Traceback" not in shown
    assert seconds < 5

"""Ends every test that takes too long, as failed; makes the figures at smoke quality once. Signals act as
in a terminal, also under nohup."""

import fcntl
import signal
import subprocess
import sys
from collections.abc import Generator
from pathlib import Path
from types import FrameType

import pytest

for number in (
    signal.SIGINT,
    signal.SIGHUP,
    signal.SIGTERM,
):  # processes of the tests inherit what is ignored
    if signal.getsignal(number) == signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL)

ROOT = Path(__file__).parents[1]
SECONDS = {False: 600, True: 1800}  # time limit of a test without its fixtures; True: of a long test


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    """Raises TimeoutError in the test; subprocess.run() then ends its process."""
    seconds = SECONDS[item.get_closest_marker("long") is not None]

    def end(_signal: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"{item.nodeid} takes more than {seconds} s: shorten it, or mark it as long")

    signal.signal(signal.SIGALRM, end)
    signal.alarm(seconds)
    try:
        return (yield)
    finally:
        signal.alarm(0)


@pytest.fixture(scope="session")
def made_at_smoke() -> subprocess.CompletedProcess[str]:
    """The command that makes all figures at smoke quality in this project and, with the study, the report."""
    target = "report" if (ROOT / "workflow/study").exists() else "figures"
    command = [sys.executable, "-m", "workflow", target, "QUALITY=smoke"]
    (ROOT / "build").mkdir(exist_ok=True)
    with (ROOT / "build/test.lock").open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)  # other workers of pytest wait
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=1800, check=False)


@pytest.fixture(scope="session")
def smoke(made_at_smoke: subprocess.CompletedProcess[str]) -> Path:
    """The folder of this project with its figures at smoke quality."""
    if made_at_smoke.returncode:
        pytest.skip("the figures at smoke quality are not made, which tests/workflow/test_smoke.py reports")
    return ROOT

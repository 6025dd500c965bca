"""Ends every test that takes too long, as failed. Signals act as in a terminal, also under nohup."""

import signal
from collections.abc import Generator
from types import FrameType

import pytest

for number in (
    signal.SIGINT,
    signal.SIGHUP,
    signal.SIGTERM,
):  # processes of the tests inherit what is ignored
    if signal.getsignal(number) == signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL)

SECONDS = {False: 600, True: 1800}  # time limit of a test with its fixtures; True: of a long test


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
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

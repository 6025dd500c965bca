"""Ends every test that takes too long, as failed."""

import signal
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from types import FrameType

import pytest

SECONDS = {False: 600, True: 1800}  # time limit of a test, and of its fixtures; True: of a long test


@contextmanager
def bounded(item: pytest.Item) -> Iterator[None]:
    """Raises TimeoutError in the test; subprocess.run() then ends its process."""
    seconds = SECONDS[item.get_closest_marker("long") is not None]

    def end(_signal: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"{item.nodeid} takes more than {seconds} s: shorten it, or mark it as long")

    before = signal.signal(signal.SIGALRM, end)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item: pytest.Item) -> Generator[None]:
    with bounded(item):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None]:
    with bounded(item):
        return (yield)

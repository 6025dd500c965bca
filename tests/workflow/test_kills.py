"""make panel, of which one process or all are killed again and again: the same command goes on, and nothing is half written."""

import os
import random
import signal
import subprocess
import time
from collections.abc import Iterator

import pytest

from tests.workflow.conftest import Clone, processes

KILLS, PANEL = 200, "fig05"
PATIENCE = 120  # seconds until what was told to end has ended


def killed(clone: Clone, chance: random.Random, seconds: float) -> str:
    """Starts make, and kills one of its processes or all of them after some time; returns what it had said when all had
    ended."""
    command = ["/usr/bin/make", "panel", f"PANEL={PANEL}", "QUALITY=smoke", "JOBS=2"]
    with subprocess.Popen(
        command,
        cwd=clone.folder,
        env={"PATH": os.defpath, "HOME": "/"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as making:
        time.sleep(chance.uniform(0, seconds))
        there = processes(making.pid)
        for victim in there if chance.random() < 0.3 else chance.sample(there, min(1, len(there))):
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                continue
        said, _ = making.communicate(timeout=PATIENCE)
        end = time.monotonic() + PATIENCE
        while processes(making.pid):
            assert time.monotonic() < end, "what was started goes on for ever"
            time.sleep(0.1)
    return said


def unmade(clone: Clone) -> Iterator[None]:
    """Without the products of the panel, to begin with and whenever they have all been made."""
    expected = clone.products()
    made = [path for path in expected if f"smoke/{PANEL}" in path]
    while True:
        for path in made:
            (clone.folder / path).unlink(missing_ok=True)
        while not all((clone.folder / path).is_file() for path in made):
            yield


@pytest.mark.long
def test_what_is_killed_at_any_moment_goes_on(kept: Clone) -> None:
    expected, chance = kept.products(), random.Random(1)
    rounds, start = unmade(kept), time.monotonic()
    next(rounds)
    assert kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke", "JOBS=2").returncode == 0
    whole = time.monotonic() - start
    for _ in range(KILLS):
        next(rounds)
        said = killed(kept, chance, whole)
        assert "Traceback" not in said, said
        assert kept.products().items() <= expected.items()
    made = kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    assert kept.products() == expected
    audited = kept.make("audit", "QUALITY=smoke", f"PANEL={PANEL}")
    assert audited.returncode == 0, audited.stdout

"""make panel, of which processes are killed, or beside which others write: the same command goes on, nothing is half written,
and nothing foreign is called made."""

import os
import random
import shutil
import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.workflow.conftest import Clone
from tests.workflow.running import kill, processes, running, soon

Tell = Callable[[int, signal.Signals], None]
KILLS, PANEL = 200, "fig05"
FRESH = ("panel", f"PANEL={PANEL}", "QUALITY=smoke", "FRESH=yes", "JOBS=1")
PATIENCE = 120  # seconds until what was told to end has ended


def killed(clone: Clone, chance: random.Random, seconds: float) -> str:
    """Starts make, and kills one of its processes or all of them after some time; returns what it had said when all had
    ended."""
    with running(clone, "panel", f"PANEL={PANEL}", "QUALITY=smoke", "JOBS=2") as making:
        time.sleep(chance.uniform(0, seconds))
        there = processes(making.pid)
        kill(there if chance.random() < 0.3 else chance.sample(there, min(1, len(there))))
        said, _ = making.communicate(timeout=PATIENCE)
        soon(lambda: not processes(making.pid), PATIENCE)
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


def test_a_killed_make_is_followed_by_the_next_and_a_running_one_is_not(kept: Clone) -> None:
    products = kept.products()
    with running(kept, *FRESH) as first:
        soon(lambda: kept.products().keys() != products.keys())  # the first product is set aside
        other = kept.make("panel", "PANEL=fig03", "QUALITY=smoke")
        os.killpg(first.pid, signal.SIGKILL)
    assert other.returncode != 0
    assert "Another make is running here" in other.stdout
    assert list((kept.folder / ".snakemake/locks").iterdir())
    made = kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    assert kept.products() == products


@pytest.mark.parametrize(
    ("number", "tell"), [(signal.SIGTERM, os.kill), (signal.SIGTERM, os.killpg), (signal.SIGHUP, os.killpg)]
)
def test_a_make_that_is_told_to_end_stops_its_jobs(kept: Clone, number: signal.Signals, tell: Tell) -> None:
    """As by a service manager, by timeout, or by a terminal that is closed; the programs write their checkpoints."""
    products = kept.products()
    many = (*FRESH, "REPLICAS=100000")
    with running(kept, *many) as making:
        soon(lambda: processes(making.pid, "build/bin/persistence"))
        time.sleep(0.5)
        tell(making.pid, number)
        said, _ = making.communicate(timeout=20)
        soon(lambda: not processes(making.pid), 20)
    assert "The same command goes on" in said
    assert "Failed" not in said
    assert "Traceback" not in said
    assert [*(kept.folder / "build/partial").rglob("*.checkpoint")]
    shutil.rmtree(kept.folder / "build/partial")
    for place in ("data", "figures"):
        shutil.rmtree(kept.folder / place / "smoke_replicas=100000", ignore_errors=True)
    assert kept.products() == products


def test_packages_and_products_are_not_removed_under_a_running_make(kept: Clone) -> None:
    with running(kept, *FRESH) as making:
        soon(lambda: processes(making.pid, "build/bin/persistence"))
        foreign = kept.folder / ".venv/lib/foreign.pth"
        foreign.touch()
        for goal in ("clean", "runtime"):
            refused = kept.make(goal)
            assert (refused.returncode, "Another make is running here" in refused.stdout) == (2, True)
        foreign.unlink()
    assert (kept.folder / ".venv/bin/python").exists()
    assert (kept.folder / "build/bin/persistence").exists()
    made = kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout


def test_a_job_that_outlives_a_killed_make_is_not_joined_by_the_next(kept: Clone) -> None:
    """It would write what is no longer asked for among the next one's products."""
    products = kept.products()
    with running(kept, *FRESH) as first:
        program = soon(lambda: processes(first.pid, "build/bin/persistence"))[0]
        os.kill(program, signal.SIGSTOP)
        kill(processes(first.pid, "workflow.execution.alone"))
        first.wait()
        other = kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke")
        os.kill(program, signal.SIGCONT)
        soon(lambda: not processes(first.pid))
    assert other.returncode != 0
    assert "A job of a make that was killed still runs here" in other.stdout
    made = kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    assert kept.products() == products


def test_what_others_write_meanwhile_is_not_called_made(kept: Clone) -> None:
    product, other = (f"data/smoke/{PANEL}/dense_sigma={sigma}.h5" for sigma in ("-0.5", "0.5"))
    foreign, before = (kept.folder / other).read_bytes(), written(kept.folder / product)
    with running(kept, *FRESH) as making:
        soon(lambda: written(kept.folder / product) not in (None, before))
        (kept.folder / product).write_bytes(foreign)
        said, _ = making.communicate()
    assert making.returncode != 0
    assert f"{product} is not what the job wrote. The same command makes it again" in said
    made = kept.make("panel", f"PANEL={PANEL}", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout


def written(path: Path) -> int | None:
    """When; none while it is set aside."""
    try:
        return path.stat().st_mtime_ns
    except FileNotFoundError:
        return None

"""On a cluster of one node: the bytes of a local run, whatever happens to the jobs."""

import contextlib
import os
import re
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TypeVar

import pytest

from tests.workflow import slurm
from tests.workflow.conftest import Clone
from tests.workflow.running import running, soon

pytestmark = pytest.mark.skipif(not slurm.available(), reason="Slurm is not installed, or runs here already")
PATIENCE = {"slurm-init-seconds-before-status-checks": "2", "latency-wait": "10"}  # of a small cluster


@pytest.fixture(scope="module")
def cluster() -> Iterator[slurm.Cluster]:
    with slurm.cluster() as one:
        yield one


def on_cluster(clone: Clone, *arguments: str) -> contextlib.AbstractContextManager[subprocess.Popen]:
    profile = clone.folder / "profiles/slurm/config.yaml"
    text = profile.read_text()
    for name, value in PATIENCE.items():
        text = re.sub(f"^{name}: .*$", f"{name}: {value}", text, flags=re.MULTILINE)
    profile.write_text(text + "seconds-between-status-checks: 3\n")
    return running(clone, *arguments, "PROFILE=slurm")


def test_parts_and_groups_make_the_same_bytes(cluster: slurm.Cluster, kept: Clone) -> None:
    products = kept.products()
    for panel in ("fig01", "fig06"):
        for path in (kept.folder / f"data/smoke/{panel}").iterdir():
            path.unlink()
    asked = ("QUALITY=smoke", "BATCH=0.01")
    for panel in ("fig01", "fig06"):
        with on_cluster(kept, "panel", f"PANEL={panel}", *asked) as making:
            said, _ = making.communicate(timeout=300)
        assert making.returncode == 0, said
    assert kept.products() == products
    logs = kept.folder / "build/logs/smoke/fig01"
    assert [path.name for path in sorted(logs.glob("paper-*/*.log"))] == ["0-0.log", "1-1.log"]
    left = [path for place in ("parts", "records") for path in (kept.folder / "build" / place).rglob("*")]
    assert not any(path.is_file() for path in left)
    audited = kept.make("audit", "QUALITY=smoke", "PANEL=fig01")
    assert "Nothing is broken" in audited.stdout, audited.stdout


T = TypeVar("T")


def instances(clone: Clone, program: str) -> list[int]:
    """Of a program of this clone."""
    path = str(clone.folder / "build/bin" / program).encode()
    found = []
    for place in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            if place.read_bytes().split(b"\0")[0] == path:
                found.append(int(place.parent.name))
    return found


def wait_for(find: Callable[[], Sequence[T]], other_than: Sequence[T] = ()) -> T:
    """The first that is found beside those."""
    return soon(lambda: [one for one in find() if one not in other_than])[0]


@pytest.mark.long
def test_a_job_that_is_ended_goes_on(cluster: slurm.Cluster, kept: Clone) -> None:
    """By scancel, by kill -9, by its time limit, while the controller is away, and while the node is drained."""
    asked, program = ("PANEL=fig01", "QUALITY=standard"), "particle_count"
    with on_cluster(kept, "panel", *asked, "BATCH=0.1") as making:
        cancelled = wait_for(cluster.jobs)
        wait_for(lambda: instances(kept, program))
        cluster.say("scancel", cancelled)
        killed = wait_for(lambda: instances(kept, program), instances(kept, program))
        os.kill(killed, signal.SIGKILL)
        cluster.stop_controller()
        time.sleep(5)
        cluster.start_controller()
        cluster.say("scontrol", "update", "NodeName=localhost", "State=DRAIN", "Reason=test")
        assert "in the queue: " in kept.make("status", "QUALITY=standard").stdout
        cluster.say("scontrol", "update", "NodeName=localhost", "State=RESUME")
        stopped = wait_for(lambda: instances(kept, program), instances(kept, program))
        os.kill(stopped, signal.SIGSTOP)
        for job in cluster.jobs():
            cluster.say("scontrol", "update", f"JobId={job}", "TimeLimit=1")
        said, _ = making.communicate(timeout=900)
    assert making.returncode == 0, said
    ended = {
        line.split()[-1]
        for line in cluster.say("squeue", "--states=all", "--format=%T", "--noheader").split()
    }
    assert {"CANCELLED", "FAILED", "TIMEOUT", "COMPLETED"} <= ended, said
    require_bytes_of_a_local_run(kept, *asked)


@pytest.mark.long
def test_a_job_goes_on_from_the_checkpoint_that_left_the_node(cluster: slurm.Cluster, kept: Clone) -> None:
    """The second attempt begins where the first was ended, and makes the bytes of an undisturbed run."""
    asked, run = ("PANEL=fig01", "QUALITY=standard"), "standard/fig01/unit-chain"
    log = kept.folder / f"build/logs/{run}.log"
    log.unlink(missing_ok=True)
    with on_cluster(kept, "panel", *asked, "BATCH=1", "FRESH=yes") as making:
        soon(lambda: len(reports(log)) > 1, seconds=300)
        assert [*slurm.DISK.glob("lorentz.*")]
        cluster.say("scancel", *cluster.jobs())
        (measured,) = soon(lambda: re.findall(r"interrupted after (\d+) replicas; --resume", told(log)))
        (checkpoint,) = soon(lambda: [*kept.folder.glob(f"build/partial/{run}-*.h5.checkpoint")])
        # Its turn may come when the other runs of the panel, which were cancelled too, are done.
        again = soon(lambda: "interrupted" not in told(log) and reports(log), seconds=900)
        assert again[0] > int(measured) > 0
        said, _ = making.communicate(timeout=900)
    assert making.returncode == 0, said
    assert not checkpoint.exists()
    assert not [*slurm.DISK.glob("lorentz.*")]
    require_bytes_of_a_local_run(kept, *asked)


def require_bytes_of_a_local_run(clone: Clone, *asked: str) -> None:
    """Results, PDF, PNG, SVG and CSV of fig01 at quality standard."""

    def products() -> dict[Path, bytes]:
        places = ("data/standard/fig01/*", "figures/standard/fig01.*")
        return {path: path.read_bytes() for place in places for path in clone.folder.glob(place)}

    before = products()
    assert len(before) == 3 + 4
    again = clone.make("panel", *asked, "FRESH=yes")
    assert again.returncode == 0, again.stdout
    assert products() == before


def told(log: Path) -> str:
    """Nothing between two attempts."""
    with contextlib.suppress(FileNotFoundError):
        return log.read_text()
    return ""


def reports(log: Path) -> list[float]:
    """Numbers of replicas, which a program tells every ten seconds."""
    return [float(number) for number in re.findall(r"(\d+\.\d) of \d+ replicas", told(log))]

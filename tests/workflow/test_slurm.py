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
from tests.workflow.running import soon

pytestmark = pytest.mark.skipif(not slurm.available(), reason="Slurm is not installed, or runs here already")
PATIENCE = {"slurm-init-seconds-before-status-checks": "2", "latency-wait": "10"}  # of a small cluster


@pytest.fixture(scope="module")
def cluster() -> Iterator[slurm.Cluster]:
    with slurm.cluster() as one:
        yield one


def on_cluster(clone: Clone, *arguments: str) -> subprocess.Popen:
    profile = clone.folder / "profiles/slurm/config.yaml"
    text = profile.read_text()
    for name, value in PATIENCE.items():
        text = re.sub(f"^{name}: .*$", f"{name}: {value}", text, flags=re.MULTILINE)
    profile.write_text(text + "seconds-between-status-checks: 3\n")
    return subprocess.Popen(
        ["/usr/bin/make", *arguments, "PROFILE=slurm"],
        cwd=clone.folder,
        env={"PATH": os.defpath, "HOME": os.environ.get("HOME", "/")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def test_parts_and_groups_make_the_same_bytes(cluster: slurm.Cluster, kept: Clone) -> None:
    products = kept.products()
    for panel in ("fig01", "fig06"):
        for path in (kept.folder / f"data/smoke/{panel}").iterdir():
            path.unlink()
    asked = ("QUALITY=smoke", "BATCH=0.01")
    for panel in ("fig01", "fig06"):
        made = on_cluster(kept, "panel", f"PANEL={panel}", *asked)
        said, _ = made.communicate(timeout=300)
        assert made.returncode == 0, said
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
    making = on_cluster(kept, "panel", *asked, "BATCH=0.1")
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
    products = {path: path.read_bytes() for path in products_of(kept)}
    again = kept.make("panel", *asked, "FRESH=yes")
    assert again.returncode == 0, again.stdout
    assert len(products) == 3 + 4
    assert {path: path.read_bytes() for path in products_of(kept)} == products


def products_of(clone: Clone) -> list[Path]:
    """Of the panel at quality standard: results, PDF, PNG, SVG and CSV."""
    return [
        *(clone.folder / "data/standard/fig01").iterdir(),
        *(clone.folder / "figures/standard").glob("fig01.*"),
    ]

"""On a cluster of one node: the bytes of a local run, whatever happens to the jobs."""

import os
import re
import subprocess
from collections.abc import Iterator

import pytest

from tests.workflow import slurm
from tests.workflow.conftest import Clone

pytestmark = [
    pytest.mark.skipif(not slurm.available(), reason="Slurm is not installed, or runs here already"),
    pytest.mark.xdist_group("slurm"),  # its configuration has one place
]
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


def test_parts_and_groups_make_the_same_bytes(cluster: slurm.Cluster, clean: Clone) -> None:
    products = clean.products()
    for panel in ("fig01", "fig06"):
        for path in (clean.folder / f"data/smoke/{panel}").iterdir():
            path.unlink()
    asked = ("QUALITY=smoke", "BATCH=0.01")
    for panel in ("fig01", "fig06"):
        made = on_cluster(clean, "panel", f"PANEL={panel}", *asked)
        said, _ = made.communicate(timeout=300)
        assert made.returncode == 0, said
    assert clean.products() == products
    logs = clean.folder / "build/logs/smoke/fig01"
    assert [path.name for path in sorted(logs.glob("paper-*/*.log"))] == ["0-0.log", "1-1.log"]
    left = [path for place in ("parts", "records") for path in (clean.folder / "build" / place).rglob("*")]
    assert not any(path.is_file() for path in left)
    audited = clean.make("audit", "QUALITY=smoke", "PANEL=fig01")
    assert "Nothing is broken" in audited.stdout, audited.stdout

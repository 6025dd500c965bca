"""On a cluster of one node, results have the bytes of a local run, also after jobs have failed."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.workflow import slurm
from tests.workflow.conftest import Clone
from tests.workflow.slurm import soon

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not slurm.available(), reason="Slurm is not installed, or runs here already"),
]
PATIENCE = "--slurm-init-seconds-before-status-checks 2 --seconds-between-status-checks 3 --latency-wait 10"
QUALITY = "standard_replicas=128"
LONG = (f"quality={QUALITY}", "panel=fig01")  # three minutes on one core


@pytest.fixture(scope="module")
def cluster() -> Iterator[slurm.Cluster]:
    with slurm.cluster() as one:
        yield one


@contextlib.contextmanager
def on_cluster(
    cluster: slurm.Cluster, clone: Clone, *config: str, option: str = "--keep-going"
) -> Iterator[subprocess.Popen[str]]:
    """Snakemake in its own session, which is killed at the end."""
    cluster.cancel_jobs()  # those that a failed test has left
    profile = ("--workflow-profile", "profiles/slurm", *PATIENCE.split(), option)
    interruptible = ("env", "--default-signal=INT")  # also where the tests run in the background of a shell
    with subprocess.Popen(
        [*interruptible, ".venv/bin/snakemake", "panel", "--nolock", *profile, "--config", *config],
        cwd=clone.folder,
        env={"PATH": os.defpath, "HOME": "/"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as making:
        try:
            yield making
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(making.pid, signal.SIGKILL)


def products(clone: Clone, quality: str) -> dict[Path, bytes]:
    """Results and figures of fig01 and fig06, without the records of the commit."""
    folders = (f"data/{quality.partition('_')[0]}/fig0[16]/*.h5", f"figures/{quality}/fig0[16].???")
    return {path: path.read_bytes() for folder in folders for path in clone.folder.glob(folder)}


def test_parts_and_batches_give_the_same_bytes(cluster: slurm.Cluster, kept: Clone) -> None:
    """The results are also fresh on one machine. A batch of 0.6 s splits every run; one of 30 minutes holds all."""
    before = products(kept, "smoke")
    for panel, batch, jobs in (("fig01", "0.01", 6), ("fig06", "30", 1)):
        for path in (kept.folder / f"data/smoke/{panel}").iterdir():
            path.unlink()
        submitted = len(cluster.command("squeue", "--noheader", "--states=all").splitlines())
        with on_cluster(cluster, kept, "quality=smoke", f"panel={panel}", f"batch={batch}") as making:
            shown, _ = making.communicate(timeout=900)
        assert making.returncode == 0, shown
        assert len(cluster.command("squeue", "--noheader", "--states=all").splitlines()) - submitted == jobs
    assert products(kept, "smoke") == before
    assert not [*(kept.folder / "build/parts").rglob("*.part")]
    assert kept.stale() == set()
    assert "fig01" in kept.module("cluster.cost", "--quality", "smoke", "--panel", "fig01")


def processes(clone: Clone, program: str) -> list[int]:
    """Processes of a program of this clone."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            command, folder = path.read_bytes().partition(b"\0")[0], path.with_name("cwd").readlink()
            if (command, folder) == (f"build/bin/{program}".encode(), clone.folder):
                found.append(int(path.parent.name))
    return found


def test_a_job_that_is_ended_goes_on(cluster: slurm.Cluster, kept: Clone) -> None:
    """Jobs end by Ctrl-C, scancel, kill -9 or their time limit, while the controller does not run, and while the node is drained."""
    program = "particle_count"
    with on_cluster(cluster, kept, *LONG, "batch=0.1") as making:
        soon(lambda: processes(kept, program), seconds=600)
        os.killpg(making.pid, signal.SIGINT)
        shown, _ = making.communicate(timeout=120)
    assert "The same command resumes." in shown
    soon(lambda: not processes(kept, program))
    with on_cluster(cluster, kept, *LONG, "batch=0.1") as making:
        (cancelled, *_) = soon(cluster.jobs, seconds=600)
        soon(lambda: processes(kept, program))
        cluster.command("scancel", cancelled)
        soon(lambda: cancelled not in cluster.jobs("RUNNING,COMPLETING"))
        os.kill(soon(lambda: processes(kept, program), seconds=600)[0], signal.SIGKILL)
        cluster.stop_controller()
        time.sleep(5)
        cluster.start_controller()
        soon(cluster.jobs)  # jobs are listed again once the controller runs
        cluster.command("scontrol", "update", "NodeName=localhost", "State=DRAIN", "Reason=test")
        time.sleep(5)
        cluster.command("scontrol", "update", "NodeName=localhost", "State=RESUME")
        os.kill(soon(lambda: processes(kept, program), seconds=600)[0], signal.SIGSTOP)
        for job in cluster.jobs():
            cluster.command("scontrol", "update", f"JobId={job}", "TimeLimit=1")
        shown, _ = making.communicate(timeout=1800)
    assert making.returncode == 0, shown
    states = {*cluster.command("squeue", "--states=all", "--format=%T", "--noheader").split()}
    assert {"CANCELLED", "FAILED", "TIMEOUT", "COMPLETED"} <= states, shown
    made = products(kept, QUALITY)
    assert len(made) == 2 + 4
    kept.run(".venv/bin/snakemake", "panel", "--forceall", "--config", *LONG)
    assert products(kept, QUALITY) == made


def test_a_part_resumes_from_its_checkpoint(cluster: slurm.Cluster, kept: Clone) -> None:
    shutil.rmtree(kept.folder / "build/logs/standard", ignore_errors=True)
    with on_cluster(cluster, kept, *LONG, "batch=1", option="--forceall") as making:
        (log,) = soon(
            lambda: [*kept.folder.glob("build/logs/standard/fig01/unit-chain.*/*_0-63.log")], seconds=600
        )
        soon(lambda: len(reports(log)) > 1, seconds=600)
        cluster.command("scancel", *cluster.jobs())
        (measured,) = soon(lambda: re.findall(r"interrupted after (\d+) replicas; --resume", text_of(log)))
        resumed = soon(lambda: "interrupted" not in text_of(log) and reports(log), seconds=1800)
        assert resumed[0] > int(measured) > 0
        shown, _ = making.communicate(timeout=1800)
    assert making.returncode == 0, shown


def text_of(log: Path) -> str:
    """Content of a log; empty if it does not exist, as between two attempts."""
    with contextlib.suppress(FileNotFoundError):
        return log.read_text()
    return ""


def reports(log: Path) -> list[float]:
    """Numbers of finished replicas that a program has printed, one every ten seconds."""
    return [float(number) for number in re.findall(r"(\d+\.\d) of \d+ replicas", text_of(log))]

"""Panels on a cluster of one node. Needs root and the packages slurm-wlm and munge."""

import os
import secrets
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.python.conftest import soon
from tests.workflow.conftest import PLAN, Project
from workflow.pipeline.queue import Queue

INSTALLED = Path("/etc/slurm/slurm.conf")  # where commands in jobs look for the configuration
FREE = os.geteuid() == 0 and all(map(shutil.which, ("munged", "slurmd"))) and not INSTALLED.exists()
pytestmark = [pytest.mark.long, pytest.mark.skipif(not FREE, reason=f"needs slurm-wlm and no {INSTALLED}")]
CONFIGURATION = """ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
AuthInfo=socket={folder}/socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}
SlurmdSpoolDir={folder}
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=2
MinJobAge={age}
EnforcePartLimits={enforced}
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2 RealMemory={memory}
PartitionName=test Nodes=ALL Default=YES MaxTime={minutes}
"""
USUAL = {"age": 3600, "enforced": "NO", "memory": 8000, "minutes": "INFINITE"}
PANEL = ("env", "--default-signal=INT", ".venv/bin/python", "-m", "workflow", "panel", "QUALITY=smoke")
Configure = Callable[..., None]


def slurm(*words: str) -> list[str]:
    """What a command of Slurm prints, in words; nothing if it fails."""
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout.split()


@pytest.fixture(scope="module")
def configure() -> Iterator[Configure]:
    """A function that changes the configuration of a Slurm on the loopback interface."""
    daemons = list[subprocess.Popen[bytes]]()

    def configure(**changes: str | int) -> None:
        (folder / "slurm.conf").write_text(CONFIGURATION.format(folder=folder, **USUAL | changes))
        slurm("scontrol", "reconfigure")

    def start(*words: str, user: str = "root") -> None:
        with (folder / f"{words[0]}.out").open("w") as log:
            daemons.append(subprocess.Popen(words, stdout=log, stderr=log, user=user, start_new_session=True))

    with tempfile.TemporaryDirectory(
        prefix="slurm."
    ) as name:  # in /tmp: the path of a socket has to be short
        folder = Path(name)
        folder.chmod(0o755)
        (folder / "key-file").write_bytes(secrets.token_bytes(1024))
        (folder / "key-file").chmod(0o400)
        for path in (folder / "key-file", folder):
            shutil.chown(path, "munge")
        files = ("key-file", "socket", "pid-file", "log-file", "seed-file")
        try:
            start(
                "munged",
                "--foreground",
                "--force",
                *(f"--{file}={folder / file}" for file in files),
                user="munge",
            )
            soon((folder / "socket").exists)
            INSTALLED.unlink(missing_ok=True)  # a link without a target, left by a killed test
            INSTALLED.symlink_to(folder / "slurm.conf")
            configure()
            start("slurmctld", "-D")
            start("slurmd", "-D", "-N", "localhost")
            soon(lambda: "idle" in slurm("sinfo", "--noheader", "--format=%t"))
            yield configure
        finally:
            for daemon in daemons[::-1]:
                daemon.terminate()
                daemon.wait(60)
            INSTALLED.unlink(missing_ok=True)


@pytest.fixture
def project(made: Project, configure: Configure, tmp_path: Path) -> Project:
    """The small project without results, in a folder without a space, and the usual cluster."""
    configure()
    project = Project(Path(shutil.copytree(made.folder, tmp_path / "no_space", symlinks=True)))
    project.edit("profiles/slurm/config.yaml", lambda text: text.replace("16", "2").replace("20", "2"))
    shutil.rmtree(project.folder / "data/smoke")
    return project


def make(project: Project, *words: str) -> subprocess.Popen[str]:
    """A command on the cluster. Ctrl-C acts on it also where tests run in the background."""
    command, pipe = [*PANEL, *words, "PROFILE=slurm"], subprocess.PIPE
    return subprocess.Popen(command, cwd=project.folder, stdout=pipe, stderr=subprocess.STDOUT, text=True)


@pytest.mark.parametrize("age", [2, 3600])  # seconds until Slurm forgets a job
def test_four_short_runs_are_one_job(configure: Configure, project: Project, made: Project, age: int) -> None:
    """Results have the bytes of those of one machine."""
    configure(age=age)
    before = slurm("squeue", "--noheader", "--states=all", "--format=%i")
    output, _ = make(project, "PANEL=energy").communicate(timeout=90)
    assert project.products() == made.products(), output
    assert len({*slurm("squeue", "--noheader", "--states=all", "--format=%i")} - {*before}) <= 1


@pytest.mark.parametrize("limit", [{"minutes": 1}, {"memory": 500}])
def test_refused_and_pending_jobs_have_a_reason(
    configure: Configure, project: Project, limit: dict[str, int]
) -> None:
    configure(enforced="ALL", **limit)
    making = make(project, "PANEL=energy")
    assert ("time limit" if "minutes" in limit else "Memory") in making.communicate(timeout=60)[0]
    assert making.returncode == 1
    if "minutes" in limit:
        configure(**limit)
        making = make(project, "PANEL=energy")
        assert making.stdout
        assert "PartitionTimeLimit" in making.stdout.readline()
        making.terminate()
        assert making.wait(10) == 128 + signal.SIGTERM
        assert not slurm("squeue", "--noheader")


@pytest.mark.parametrize(("number", "sent"), [(50, signal.SIGTERM), (2, signal.SIGINT)])
def test_stopped_jobs_are_cancelled_and_resume(project: Project, number: int, sent: signal.Signals) -> None:
    """Jobs of fifty runs while most are still to be submitted, and of two that write checkpoints."""
    longer = PLAN.replace("-0.5, 0.5", ", ".join(f"{n / 100}" for n in range(number)))
    (project.folder / "workflow/config/paper.yaml").write_text(longer.replace("time: 5}", "time: 2000}", 1))
    words, folder = ("PANEL=mu", "REPLICAS=2000"), project.folder / "data/smoke_replicas=2000/mu"
    making = make(project, *words)
    soon(lambda: [*folder.glob("*.log")] if number == 2 else slurm("squeue", "--noheader"))
    time.sleep(2)
    making.send_signal(sent)
    making.communicate(timeout=10)
    assert making.returncode == 128 + sent
    soon(lambda: not slurm("squeue", "--noheader"), 20)
    if number == 2:
        assert [*folder.glob("*.checkpoint")]
        making = make(project, *words)
        slurm("scancel", soon(lambda: slurm("squeue", "--noheader", "--states=RUNNING", "--format=%i"))[0])
        making.communicate(timeout=300)
        resumed = {path: path.read_bytes() for path in folder.glob("*.h5*")}
        for path in resumed:
            path.unlink()
        project.run(*PANEL, *words)
        assert {path: path.read_bytes() for path in folder.glob("*.h5")} == resumed


def test_forgotten_jobs_are_lost(
    configure: Configure, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """But not those that ended a short time ago, nor while Snakemake prints or squeue fails."""
    configure()

    def is_lost(name: str = "absent", printed: str = "") -> bool:
        (tmp_path / "log").write_text(f"SLURM run ID: {name}\n")
        queue = Queue(tmp_path / "log")
        for _ in range(3):
            with (tmp_path / "log").open("a") as log:
                log.write(printed)
            queue.look()
        return queue.is_lost

    assert is_lost()
    assert not is_lost(printed="rendered")
    slurm("sbatch", "--job-name=present", "--output=/dev/null", "--wrap=true")
    soon(lambda: not slurm("squeue", "--noheader"))
    assert not is_lost("present")
    monkeypatch.setenv("SLURM_CONF", "/absent")
    assert not is_lost()

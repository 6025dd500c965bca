"""A panel on a cluster of one node, with results of the same bytes as without. Needs root and the packages
slurm-wlm and munge."""

import os
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.python.conftest import soon
from tests.workflow.conftest import Project

DAEMONS = ("munged", "slurmctld", "slurmd")
INSTALLED = Path("/etc/slurm/slurm.conf")  # where commands in jobs look for the configuration
FREE = os.geteuid() == 0 and all(map(shutil.which, DAEMONS)) and not INSTALLED.exists()

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not FREE, reason=f"needs root, munge, slurm-wlm and no {INSTALLED}"),
]
CONFIGURATION = """ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=2
MpiDefault=none
ReturnToService=2
KillWait=10
AccountingStorageType=accounting_storage/none
MinJobAge=3600
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2 RealMemory=8000 State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Cluster:
    """A Slurm of one node on the loopback interface, with all its files in a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._daemons = folder, list[subprocess.Popen]()

    def start(self) -> None:
        munge = self._folder / "munge"
        for path in (munge, self._folder / "state", self._folder / "spool"):
            path.mkdir()
        with socket.create_server(("127.0.0.1", 0)) as one, socket.create_server(("127.0.0.1", 0)) as two:
            ports = {"controller": one.getsockname()[1], "node": two.getsockname()[1]}
        (self._folder / "slurm.conf").write_text(CONFIGURATION.format(folder=self._folder, **ports))
        INSTALLED.unlink(missing_ok=True)  # a link without a target, left by a killed test
        INSTALLED.symlink_to(self._folder / "slurm.conf")
        (munge / "key").write_bytes(secrets.token_bytes(1024))
        (munge / "key").chmod(0o400)
        for path in (munge / "key", munge):
            shutil.chown(path, "munge", "munge")
        names = {
            "key-file": "key",
            "socket": "socket",
            "pid-file": "pid",
            "log-file": "log",
            "seed-file": "seed",
        }
        self._run("munged", "--foreground", "--force", *(f"--{option}={munge / name}" for option, name in names.items()),
                  user="munge")  # fmt: skip
        soon((munge / "socket").exists)
        self._run("slurmctld", "-D")
        self._run("slurmd", "-D", "-N", "localhost")
        soon(lambda: "idle" in self.command("sinfo", "--noheader", "--format=%t"))

    def stop(self) -> None:
        if len(self._daemons) == len(DAEMONS):
            self.command("scancel", "--user=root")
            soon(lambda: not self.jobs("PENDING,RUNNING,COMPLETING"))
        for daemon in self._daemons[::-1]:
            daemon.terminate()
            daemon.wait(60)

    def command(self, *words: str) -> str:
        """Output of a command of Slurm; empty if it fails."""
        done = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
        return done.stdout if done.returncode == 0 else ""

    def jobs(self, states: str) -> list[str]:
        """Numbers of the jobs in these states."""
        return self.command("squeue", "--noheader", f"--states={states}", "--format=%i").split()

    def _run(self, *words: str, user: str | None = None) -> None:
        with (self._folder / f"{words[0]}.out").open("w") as log:
            self._daemons.append(subprocess.Popen(
                words, user=user, group=user, stdout=log, stderr=log, start_new_session=True
            ))  # fmt: skip


@pytest.fixture
def cluster() -> Iterator[Cluster]:
    folder = Path(tempfile.mkdtemp(prefix="slurm."))  # in /tmp, as the path of a socket has to be short
    folder.chmod(0o755)
    instance = Cluster(folder)
    try:
        instance.start()
        yield instance
    finally:
        instance.stop()
        INSTALLED.unlink(missing_ok=True)
        shutil.rmtree(folder)


def test_a_panel_is_submitted_cancelled_and_resumed(cluster: Cluster, made: Project, tmp_path: Path) -> None:
    """Results have the bytes of those of one machine: of four short runs in one job; and of two longer
    ones that Ctrl-C and then scancel end."""
    project = Project(Path(shutil.copytree(made.folder, tmp_path / "no_space", symlinks=True)))
    quicker = {"threads: 16": "threads: 2", "checks: 20": "checks: 2", "latency-wait: 60": "latency-wait: 10"}
    for old, new in quicker.items():
        project.edit("profiles/slurm/config.yaml", lambda text, old=old, new=new: text.replace(old, new))
    local = [".venv/bin/python", "-m", "workflow", "panel", "QUALITY=smoke"]
    before = project.products()
    shutil.rmtree(project.folder / "data/smoke")
    project.run(*local, "PANEL=energy", "PROFILE=slurm")
    assert project.products() == before
    assert len(cluster.jobs("all")) == 1

    shutil.rmtree(project.folder / "data/smoke")
    project.edit("workflow/config/paper.yaml", lambda text: text.replace("time: 5}", "time: 2000}", 1))
    local += ["PANEL=mu", "REPLICAS=2000"]
    logs, checkpoints, results = (
        f"data/smoke_replicas=2000/mu/*.{kind}" for kind in ("log", "h5.checkpoint", "h5")
    )
    with make(project, local) as making:
        soon(lambda: [*project.folder.glob(logs)])
        time.sleep(2)
        os.killpg(making.pid, signal.SIGINT)
        making.communicate(timeout=120)
    assert making.returncode
    soon(lambda: not cluster.jobs("PENDING,RUNNING,COMPLETING"))
    assert [*project.folder.glob(checkpoints)]

    with make(project, local) as making:
        cluster.command("scancel", soon(lambda: cluster.jobs("RUNNING"))[0])
        making.communicate(timeout=600)
    assert making.returncode == 0
    assert len(cluster.jobs("CANCELLED")) >= 2
    assert len(cluster.jobs("COMPLETED")) == 3
    assert not [*project.folder.glob(checkpoints)]
    resumed = {path: path.read_bytes() for path in project.folder.glob(results)}
    for path in resumed:
        path.unlink()
    project.run(*local)
    assert {path: path.read_bytes() for path in project.folder.glob(results)} == resumed


def make(project: Project, words: list[str]) -> subprocess.Popen[str]:
    """A command on the cluster, in a session of its own, with SIGINT as in a terminal also where the tests
    run in the background."""
    command = ["env", "--default-signal=INT", *words, "PROFILE=slurm"]
    return subprocess.Popen(
        command, cwd=project.folder, stdout=subprocess.PIPE, text=True, start_new_session=True
    )

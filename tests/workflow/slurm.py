"""A Slurm of one node that listens on loopback only, for tests. It has to be started by root."""

import contextlib
import os
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.workflow.running import soon

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
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
TaskProlog={folder}/prolog
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2
MpiDefault=none
ReturnToService=2
KillWait=10
JobAcctGatherType=jobacct_gather/linux
AccountingStorageType=accounting_storage/none
MinJobAge=3600
NodeName=localhost NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=8000 State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def available() -> bool:
    programs = ("slurmctld", "slurmd", "munged", "sbatch", "scontrol")
    return (
        os.geteuid() == 0
        and (not os.path.lexists(PLACE) or left_behind())
        and all(shutil.which(program, path=PATH) for program in programs)
    )


def left_behind() -> bool:
    """Whether the configuration is that of tests that were killed: its controller is gone."""
    if not PLACE.is_symlink() or not PLACE.readlink().parent.name.startswith(PREFIX):
        return False
    pid = PLACE.readlink().with_name("slurmctld.pid")
    return not (pid.is_file() and Path("/proc", pid.read_text().strip(), "comm").is_file())


PLACE = Path("/etc/slurm/slurm.conf")
PREFIX = "slurm."  # of a cluster's folder
DISK = Path("/dev/shm")  # what a node's own disk is for the others
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"


class Cluster:
    def __init__(self, folder: Path, cpus: int) -> None:
        self.folder = folder
        self.environment = {"PATH": PATH}
        self._daemons: dict[str, subprocess.Popen] = {}
        for name in ("state", "spool", "munge"):
            (folder / name).mkdir()
        ports = dict(zip(("controller", "node"), _free_ports(2), strict=True))
        text = CONFIGURATION.format(folder=folder, cpus=cpus, **ports)
        (folder / "slurm.conf").write_text(text)
        prolog = folder / "prolog"
        prolog.write_text(f"#!/bin/sh\necho export TMPDIR={DISK}\n")
        prolog.chmod(0o755)

    def start(self) -> None:
        self._install()
        munge = self.folder / "munge"
        (munge / "key").write_bytes(secrets.token_bytes(1024))
        for path, mode in ((munge / "key", 0o400), (munge, 0o755)):
            path.chmod(mode)
            shutil.chown(path, "munge", "munge")
        files = {
            "key-file": "key",
            "socket": "socket",
            "pid-file": "pid",
            "log-file": "log",
            "seed-file": "seed",
        }
        self._run("munged", "--foreground", "--force", *(f"--{key}={munge / name}" for key, name in files.items()),
                  user="munge")  # fmt: skip
        soon((munge / "socket").exists)
        self.start_controller()
        self._run("slurmd", "-D", "-N", "localhost")
        soon(lambda: "idle" in self.say("sinfo", "--noheader", "--format=%t"))

    def start_controller(self) -> None:
        self._run("slurmctld", "-D")

    def stop_controller(self) -> None:
        self._end("slurmctld")

    def _install(self) -> None:
        """Where Slurm's commands look for it, as the executor hands no variable to those that it starts in a job."""
        PLACE.parent.mkdir(exist_ok=True)
        PLACE.unlink(missing_ok=True)  # left behind, or there would be no cluster here
        PLACE.symlink_to(self.folder / "slurm.conf")

    def stop(self) -> None:
        """Whatever still runs, as after a test that failed, ends before the daemons that could end it."""
        with contextlib.suppress(subprocess.SubprocessError, AssertionError):
            self.say("scancel", "--user=root")
            soon(lambda: not self.say("squeue", "--noheader", "--states=RUNNING,COMPLETING"))
        PLACE.unlink(missing_ok=True)
        for name in [*self._daemons][::-1]:
            self._end(name)

    def say(self, *command: str) -> str:
        """What one of Slurm's commands prints; empty if it fails, as while the controller is away."""
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=60, check=False
        )
        return done.stdout if done.returncode == 0 else ""

    def jobs(self) -> list[str]:
        """Numbers of the jobs that run."""
        return self.say("squeue", "--noheader", "--states=RUNNING", "--format=%i").split()

    def _run(self, name: str, *arguments: str, user: str | None = None) -> None:
        with (self.folder / f"{name}.out").open("a") as log:
            self._daemons[name] = subprocess.Popen(
                [name, *arguments], env=self.environment, user=user, group=user, stdout=log, stderr=log, start_new_session=True
            )  # fmt: skip

    def _end(self, name: str) -> None:
        daemon = self._daemons.pop(name)
        daemon.send_signal(signal.SIGTERM)
        try:
            daemon.wait(20)
        except subprocess.TimeoutExpired:
            daemon.kill()
            daemon.wait()


@contextlib.contextmanager
def cluster(cpus: int = 2) -> Iterator[Cluster]:
    """Below /tmp, as the path of a socket must be short and its folder open to another user."""
    folder = Path(tempfile.mkdtemp(prefix=PREFIX))
    folder.chmod(0o755)
    one = Cluster(folder, cpus)
    try:
        one.start()
        yield one
    finally:
        one.stop()
        shutil.rmtree(folder, ignore_errors=True)


def _free_ports(number: int) -> list[int]:
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(number)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports

"""A Slurm cluster of one node on the loopback interface, for tests. It needs root."""

import contextlib
import os
import secrets
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")

INSTALLED = Path("/etc/slurm/slurm.conf")  # default path of the configuration, which commands in jobs use too
PREFIX = "slurm."  # prefix of the folder of a cluster
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
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
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2
MpiDefault=none
ReturnToService=2
KillWait=10
JobAcctGatherType=jobacct_gather/linux
AccountingStorageType=accounting_storage/none
MinJobAge=3600
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2 RealMemory=8000 State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def available() -> bool:
    programs = ("slurmctld", "slurmd", "munged", "sbatch", "scontrol")
    free = not os.path.lexists(INSTALLED) or left_behind()
    return os.geteuid() == 0 and free and all(shutil.which(program, path=PATH) for program in programs)


def left_behind() -> bool:
    """Whether the installed configuration was left by killed tests: its controller does not run."""
    if not INSTALLED.is_symlink() or not INSTALLED.readlink().parent.name.startswith(PREFIX):
        return False
    pid = INSTALLED.readlink().with_name("slurmctld.pid")
    return not (pid.is_file() and Path("/proc", pid.read_text().strip(), "comm").is_file())


class Cluster:
    def __init__(self, folder: Path) -> None:
        self._folder, self._munge = folder, folder / "munge"
        self._daemons: dict[str, subprocess.Popen] = {}

    def start(self) -> None:
        for name in ("state", "spool", "munge"):
            (self._folder / name).mkdir()
        controller, node = _free_ports(2)
        text = CONFIGURATION.format(folder=self._folder, controller=controller, node=node)
        (self._folder / "slurm.conf").write_text(text)
        INSTALLED.parent.mkdir(exist_ok=True)
        INSTALLED.unlink(missing_ok=True)  # left by killed tests, as no cluster runs here
        INSTALLED.symlink_to(self._folder / "slurm.conf")
        (self._munge / "key").write_bytes(secrets.token_bytes(1024))
        for path, mode in ((self._munge / "key", 0o400), (self._munge, 0o755)):
            path.chmod(mode)
            shutil.chown(path, "munge", "munge")
        names = {
            "key-file": "key",
            "socket": "socket",
            "pid-file": "pid",
            "log-file": "log",
            "seed-file": "seed",
        }
        files = [f"--{option}={self._munge / name}" for option, name in names.items()]
        self._run("munged", "--foreground", "--force", *files, user="munge")
        soon((self._munge / "socket").exists)
        self.start_controller()
        self._run("slurmd", "-D", "-N", "localhost")
        soon(lambda: "idle" in self.command("sinfo", "--noheader", "--format=%t"))

    def start_controller(self) -> None:
        self._run("slurmctld", "-D")

    def stop_controller(self) -> None:
        self._end("slurmctld")

    def stop(self) -> None:
        with contextlib.suppress(subprocess.SubprocessError, AssertionError):
            self.cancel_jobs()  # while the daemons run that can end them
        INSTALLED.unlink(missing_ok=True)
        for name in [*self._daemons][::-1]:
            self._end(name)

    def cancel_jobs(self) -> None:
        self.command("scancel", "--user=root")
        soon(lambda: not self.command("squeue", "--noheader", "--states=PENDING,RUNNING,COMPLETING"))

    def command(self, *words: str) -> str:
        """Output of a command of Slurm; empty if it fails, for instance without a controller."""
        done = subprocess.run(
            words, env={"PATH": PATH}, capture_output=True, text=True, timeout=60, check=False
        )
        return done.stdout if done.returncode == 0 else ""

    def jobs(self, states: str = "RUNNING") -> list[str]:
        """Numbers of the jobs in these states."""
        return self.command("squeue", "--noheader", f"--states={states}", "--format=%i").split()

    def _run(self, name: str, *arguments: str, user: str | None = None) -> None:
        with (self._folder / f"{name}.out").open("a") as log:
            self._daemons[name] = subprocess.Popen(
                [name, *arguments], env={"PATH": PATH}, user=user, group=user, stdout=log, stderr=log, start_new_session=True
            )  # fmt: skip

    def _end(self, name: str) -> None:
        daemon = self._daemons.pop(name)
        daemon.terminate()
        try:
            daemon.wait(20)
        except subprocess.TimeoutExpired:
            daemon.kill()
            daemon.wait()


@contextlib.contextmanager
def cluster() -> Iterator[Cluster]:
    """A running cluster. Its folder is below /tmp, as the path of a socket must be short and accessible to another user."""
    folder = Path(tempfile.mkdtemp(prefix=PREFIX))
    folder.chmod(0o755)
    instance = Cluster(folder)
    try:
        instance.start()
        yield instance
    finally:
        instance.stop()
        shutil.rmtree(folder, ignore_errors=True)


def soon(find: Callable[[], T], seconds: float = 120) -> T:
    """Waits for a true value and returns it."""
    deadline = time.monotonic() + seconds
    while not (found := find()):
        assert time.monotonic() < deadline, f"not within {seconds:g} seconds"
        time.sleep(0.05)
    return found


def _free_ports(number: int) -> list[int]:
    with contextlib.ExitStack() as sockets:
        return [
            sockets.enter_context(socket.create_server(("127.0.0.1", 0))).getsockname()[1]
            for _ in range(number)
        ]

"""Full streams and disks, and too few threads: no result is lost without a message."""

import os
import resource
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.python.conftest import Program, command_line


def limited(folder: Path, limits: dict[int, int], options: dict, name: str) -> subprocess.CompletedProcess:
    """Runs a program under limits of its resources. The signals that the system sends where one is exceeded have their default action."""

    def limit() -> None:
        for kind, size in limits.items():
            resource.setrlimit(kind, (size, size))

    return subprocess.run(command_line(name, {"output": "out.h5", **options}), cwd=folder, capture_output=True,
                          env={"PATH": os.defpath}, text=True, timeout=120, check=False, preexec_fn=limit)  # fmt: skip


def test_no_result_is_lost_where_standard_error_is_full(persistence: Program, tmp_path: Path) -> None:
    assert persistence(output="whole.h5").returncode == 0
    command = command_line("persistence", {"output": "out.h5", "progress": "log"})
    with open("/dev/full", "w") as full:
        assert subprocess.run(command, cwd=tmp_path, stderr=full, check=False).returncode == 0
    assert (tmp_path / "out.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()


def test_no_result_is_lost_with_a_reader_of_standard_error(tmp_path: Path) -> None:
    options = {"output": "out.h5", "progress": "bar", "observation-time": 30_000}
    process = subprocess.Popen(command_line("persistence", options), cwd=tmp_path, stderr=subprocess.PIPE)
    process.stderr.close()
    assert process.wait(timeout=60) == 0
    assert (tmp_path / "out.h5").is_file()


# More than is reserved before the run, less than the result: the failure comes at the end.
LARGE = {"momentum-bins": 20_000, "observation-time": 0.1, "relaxation-time": 0}


def test_a_result_beyond_the_space_leaves_the_former_one(tmp_path: Path) -> None:
    (tmp_path / "out.h5").write_bytes(b"former")
    options = {**LARGE, "progress": "none", "overwrite": True}
    result = limited(tmp_path, {resource.RLIMIT_FSIZE: 300_000}, options, "momentum_flux")
    assert result.returncode == 2
    assert "error: 'out.h5' cannot be written: " in result.stderr
    assert "4 replicas, which are not saved: 'out.h5.checkpoint' cannot be written: " in result.stderr
    assert (tmp_path / "out.h5").read_bytes() == b"former"
    assert [path.name for path in tmp_path.iterdir()] == ["out.h5"]


# The stack of a thread takes address space.
def test_threads_that_the_system_does_not_start(tmp_path: Path) -> None:
    limits = {resource.RLIMIT_STACK: 1000 << 20, resource.RLIMIT_AS: 3700 << 20}
    result = limited(tmp_path, limits, {"threads": 4, "progress": "none"}, "persistence")
    assert result.returncode == 2
    assert result.stderr.startswith("persistence: error: --threads: the system starts only 3: ")
    assert result.stderr.count("\n") == 1
    assert not (tmp_path / "out.h5").exists()  # a checkpoint of finished replicas may remain


BIG = {
    "persistence": {"cells": 3_000_000, "particles-per-cell": 4, "threads": 1},
    "boltzmann": {"cells": 300, "momentum-bins": 100_000, "coarsening": 4, "target-error": 1, "gamma": "N"},
}


@pytest.mark.parametrize(("name", "number"), [("persistence", signal.SIGINT), ("boltzmann", signal.SIGTERM)])
def test_a_signal_during_a_long_setup(tmp_path: Path, name: str, number: signal.Signals) -> None:
    command = command_line(name, {**BIG[name], "output": "out.h5"})
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE)
    time.sleep(0.7)
    process.send_signal(number)
    begin = time.monotonic()
    try:
        process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 128 + number
    assert time.monotonic() - begin < 4
    assert list(tmp_path.iterdir()) == []

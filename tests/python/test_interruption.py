"""Interrupted runs, signals, closed streams, full disks: no result is lost without a message."""

import resource
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.python.conftest import Program, command_line, soon

# The jackknife of 2000 replicas takes half of the run time of displacement, so that it is interrupted too.
LONG = {
    "persistence": {"observation-time": 2000, "replicas": 60},
    "displacement": {"cells": 5, "particles-per-cell": 2, "relaxation-time": 0, "observation-time": 1, "decades": 11,
                     "replicas": 2000},
    "energy_pulse": {"relaxation-time": 4, "pairs-per-replica": 1, "replicas": 100},
}  # fmt: skip


@pytest.mark.parametrize("name", LONG)
def test_interrupted_and_resumed_run_gives_the_same_bytes(
    program: Program, tmp_path: Path, name: str
) -> None:
    options = LONG[name] | {"checkpoint-interval": 0.1}
    keywords = {key.replace("-", "_"): value for key, value in options.items()}
    begin = time.monotonic()
    assert program(name, **keywords, threads=1, output="whole.h5").returncode == 0
    duration, interrupted = time.monotonic() - begin, 0
    for part, number in ((0.3, signal.SIGTERM), (0.6, signal.SIGKILL)):
        command = command_line(name, {**options, "threads": 1, "output": "out.h5"})
        process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL)
        time.sleep(part * duration)
        process.send_signal(number)
        sent = time.monotonic()
        status = process.wait(timeout=30)
        assert time.monotonic() - sent < 2
        if status != 0:  # else it was faster than the first run
            interrupted += 1
            assert status == (-number if number == signal.SIGKILL else 128 + number)
            assert not (tmp_path / "out.h5").exists()
            assert program(name, **keywords, threads=2, resume=True).returncode == 0
        assert (tmp_path / "out.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()
        for path in tmp_path.glob("out*"):  # a kill may leave a temporary file
            assert path.suffix in (".json", ".h5", ".tmp")
            path.unlink()
    assert interrupted


def test_a_closed_terminal_is_ignored_with_nohup(tmp_path: Path) -> None:
    options = LONG["persistence"] | {"checkpoint-interval": 0.1, "output": "out.h5"}
    command = ["nohup", *command_line("persistence", options)]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL)
    soon((tmp_path / "out.h5.checkpoint").exists)
    process.send_signal(signal.SIGHUP)
    assert process.wait(timeout=60) == 0
    assert (tmp_path / "out.h5").is_file()


def test_no_result_is_lost_with_a_reader_of_standard_error(tmp_path: Path) -> None:
    options = {"output": "out.h5", "progress": "log", "observation-time": 30_000}
    process = subprocess.Popen(command_line("persistence", options), cwd=tmp_path, stderr=subprocess.PIPE)
    process.stderr.close()
    assert process.wait(timeout=60) == 0
    assert (tmp_path / "out.h5").is_file()


def test_a_result_beyond_the_space_leaves_the_former_one(tmp_path: Path) -> None:
    """The result is larger than what is reserved before the run, so that writing fails at the end."""
    (tmp_path / "out.h5").write_bytes(b"former")
    large = {"momentum-bins": 20_000, "observation-time": 0.1, "relaxation-time": 0}
    options = {"output": "out.h5", "progress": "none", "overwrite": True}
    done = subprocess.run(
        command_line("momentum_flux", large | options),
        cwd=tmp_path, capture_output=True, text=True, check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, 300_000)),
    )  # fmt: skip
    assert done.returncode == 2
    assert "error: 'out.h5' cannot be written: " in done.stderr
    assert "4 replicas, which are not saved: 'out.h5.checkpoint' cannot be written: " in done.stderr
    assert (tmp_path / "out.h5").read_bytes() == b"former"
    assert [path.name for path in tmp_path.iterdir()] == ["out.h5"]


def test_a_signal_during_a_long_setup(tmp_path: Path) -> None:
    big = {"cells": 3_000_000, "particles-per-cell": 4, "threads": 1, "output": "out.h5"}
    process = subprocess.Popen(command_line("persistence", big), cwd=tmp_path, stderr=subprocess.PIPE)
    time.sleep(0.7)
    process.terminate()
    begin = time.monotonic()
    try:
        process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 128 + signal.SIGTERM
    assert time.monotonic() - begin < 4
    assert list(tmp_path.iterdir()) == []

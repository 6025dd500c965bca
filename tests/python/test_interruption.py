"""Runs that are interrupted at any time, and outputs that several processes use: nothing is lost."""

import fcntl
import signal
import subprocess
import time
from pathlib import Path

from tests.python.conftest import Program, command_line


def test_no_interruption_loses_more_than_a_checkpoint_interval(program: Program, tmp_path: Path) -> None:
    """The jackknife of 2000 replicas takes half of the run time, so that it is interrupted too."""
    options = {"cells": 5, "particles-per-cell": 2, "relaxation-time": 0, "observation-time": 1, "decades": 11,
               "replicas": 2000, "threads": 1, "checkpoint-interval": 0.1}  # fmt: skip
    keywords = {key.replace("-", "_"): value for key, value in options.items()}
    begin = time.monotonic()
    assert program("displacement", **keywords, output="whole.h5").returncode == 0
    duration, interrupted = time.monotonic() - begin, 0
    for part, number in (
        (0.2, signal.SIGINT),
        (0.4, signal.SIGTERM),
        (0.6, signal.SIGINT),
        (0.8, signal.SIGTERM),
    ):
        command = command_line("displacement", {**options, "output": "out.h5"})
        process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL)
        time.sleep(part * duration)
        process.send_signal(number)
        sent = time.monotonic()
        status = process.wait(timeout=30)
        assert time.monotonic() - sent < 2
        if status == 0:  # it was faster than the first run
            (tmp_path / "out.h5").unlink()
            continue
        assert status == 128 + number
        interrupted += 1
        assert program("displacement", **keywords, resume=True).returncode == 0
        assert (tmp_path / "out.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()
        assert sorted(path.name for path in tmp_path.glob("out*")) == ["out.cost.json", "out.h5"]
        (tmp_path / "out.h5").unlink()
    assert interrupted


def test_processes_with_one_output(tmp_path: Path) -> None:
    command = command_line("persistence", {"output": "out.h5", "progress": "none"})
    processes = [subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE) for _ in range(6)]
    assert [process.communicate()[1] for process in processes] == [b""] * 6
    assert [process.returncode for process in processes] == [0] * 6
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.cost.json", "out.h5"]


def test_a_locked_output_is_not_damaged(persistence: Program, tmp_path: Path) -> None:
    assert persistence().returncode == 0
    with open(tmp_path / "out.h5") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        assert persistence(overwrite=None).returncode == 0
        refused = persistence(overwrite=None, sigma=0.25)
    assert refused.returncode == 2
    assert "another --sigma" in refused.stderr

"""Interrupted runs, signals, closed streams, full disks: no result is lost without a message."""

import signal
import subprocess
import time
from functools import partial
from pathlib import Path

from tests.python.conftest import Program, command_line, soon
from workflow.lib.load import cpu_seconds

# The jackknife of 2000 replicas takes half of the run time, so that it is interrupted too.
LONG: dict[str, object] = {"cells": 5, "particles-per-cell": 3, "relaxation-time": 0, "observation-time": 1}
LONG |= {"decades": 11, "replicas": 2000, "checkpoint-interval": 0.1}


def test_interrupted_and_resumed_run_gives_the_same_bytes(program: Program, tmp_path: Path) -> None:
    keywords = {key.replace("-", "_"): value for key, value in LONG.items()}
    run = partial(program, "displacement", **keywords)
    begin = time.monotonic()
    assert run(threads=1, output="whole.h5").returncode == 0
    duration, interrupted = time.monotonic() - begin, 0
    for part, number in ((0.3, signal.SIGTERM), (0.6, signal.SIGKILL)):
        command = command_line("displacement", {**LONG, "threads": 1, "output": "out.h5"})
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
            assert run(threads=2, resume=True).returncode == 0
        assert (tmp_path / "out.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()
        assert cpu_seconds(tmp_path / "out.h5") > 0.7 * cpu_seconds(tmp_path / "whole.h5")
        for path in tmp_path.glob("out*"):  # a kill may leave a temporary file
            assert path.suffix in (".json", ".h5", ".tmp")
            path.unlink()
    assert interrupted


def test_a_closed_terminal_is_ignored_with_nohup(tmp_path: Path) -> None:
    command = ["nohup", *command_line("displacement", {**LONG, "output": "out.h5"})]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL)
    soon((tmp_path / "out.h5.checkpoint").exists)
    process.send_signal(signal.SIGHUP)
    assert process.wait(timeout=60) == 0
    assert (tmp_path / "out.h5").is_file()

"""Closed streams, full disks, signals: no result is lost without a message."""

import resource
import signal
import subprocess
import time
from pathlib import Path

from tests.python.conftest import command_line


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

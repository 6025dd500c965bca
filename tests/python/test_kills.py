"""Programs that are killed at random moments, again and again, and go on: the same bytes, and never half a file."""

import os
import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.python.conftest import command_line

# A checkpoint is written whenever a replica is done.
OFTEN = {"checkpoint-interval": 1e-4}
RUNS = {
    "persistence": {"observation-time": 1000, "replicas": 400},
    "conductivity": {"particles-per-cell": None, "cells": 8, "observation-time": 40, "replicas": 400},
    "correlation": {"cells": 11, "times": "1,2", "observation-time": 400, "replicas": 200},
}


def start(name: str, folder: Path) -> subprocess.Popen:
    options = {**RUNS[name], **OFTEN, "output": "out.h5", "progress": "none", "resume": True, "threads": 2}
    return subprocess.Popen(
        command_line(name, options), cwd=folder, env={"PATH": os.defpath}, stderr=subprocess.PIPE
    )


def finished(name: str, folder: Path) -> bytes:
    """A ring of so few cells has no peak, which correlation says with status 4."""
    process = start(name, folder)
    _, said = process.communicate(timeout=120)
    assert process.returncode in (0, 4), said
    return (folder / "out.h5").read_bytes()


@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize("kills", [3, pytest.param(40, marks=pytest.mark.long)])
def test_killed_and_resumed(tmp_path: Path, name: str, kills: int) -> None:
    """Until so many kills have left a checkpoint; those before the first replica and after the last come on top."""
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    whole.mkdir()
    broken.mkdir()
    begin = time.monotonic()
    expected, moments, left = finished(name, whole), random.Random(name), 0
    most = 0.7 * (time.monotonic() - begin)
    for _ in range(50 * kills):
        process = start(name, broken)
        time.sleep(moments.uniform(0, most))
        process.send_signal(signal.SIGKILL)
        process.communicate()
        left += (broken / "out.h5.checkpoint").exists()
        if (broken / "out.h5").exists():  # it was killed after its end, or not at all
            assert (broken / "out.h5").read_bytes() == expected
            (broken / "out.h5").unlink()
        if left == kills:
            break
    assert left == kills
    assert finished(name, broken) == expected
    assert {path.name for path in broken.iterdir()} == {path.name for path in whole.iterdir()}

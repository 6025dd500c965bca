import os
import subprocess
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

# A chain that runs for a fraction of a second.
SMALL = {"cells": 5, "particles-per-cell": 4, "relaxation-time": 5, "observation-time": 10, "replicas": 4}

Program = Callable[..., subprocess.CompletedProcess]


def command_line(program: str, options: dict) -> list[str]:
    """A value of True gives a flag; None omits an option of SMALL."""
    words = [str(ROOT / "build/bin" / program)]
    for name, value in {**SMALL, **options}.items():
        if value is True:
            words.append(f"--{name}")
        elif value is not None:
            words += [f"--{name}", str(value)]
    return words


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """Runs a program in an empty folder. Options are keywords with underscores instead of dashes."""

    def run(name: str, **options: object) -> subprocess.CompletedProcess:
        named = {key.replace("_", "-"): value for key, value in options.items()}
        return subprocess.run(
            command_line(name, {"output": "out.h5", "overwrite": True, "progress": "none", **named}),
            cwd=tmp_path,
            env={"PATH": os.defpath},
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )

    return run


@pytest.fixture
def persistence(program: Program) -> Program:
    return partial(program, "persistence")

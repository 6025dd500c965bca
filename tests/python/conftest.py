import os
import subprocess
import time
import zlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TypeVar

import h5py
import numpy as np
import pytest
from scipy.stats import chi2, norm

from tests.python.described import options_of_programs
from workflow.lib.load import Result, load
from workflow.pipeline.configuration import arguments
from workflow.pipeline.plan import Plan, Run

ROOT = Path(__file__).parents[2]
T = TypeVar("T")

GENERAL = {"cells": 5, "particles-per-cell": 3, "relaxation-time": 5, "observation-time": 10, "replicas": 4}
NAMED: dict[str, dict[str, object]] = {
    "heat_current": {"cells": 20, "observation-time": 10, "times": "1,2,4", "replicas": 4},
    "energy_pulse": {"cells": 21, "particles-per-cell": 20, "times": "0.01,0.014", "replicas": 4},
    "particle_count": {"cells": 5, "times": "2,5,10", "replicas": 4},
    "boltzmann": {},
}

Program = Callable[..., subprocess.CompletedProcess]
Measure = Callable[..., Result]
OverSeeds = Callable[..., dict[str, np.ndarray]]


planned = cache(Plan)  # by the name of a selection


def seal(path: Path) -> None:
    """Appends the checksum to a result that was edited, as a program does."""
    content = path.read_bytes()
    path.write_bytes(content + b"%08x" % zlib.crc32(content))


def sampled(run: Run) -> bool:
    """Whether the run has random numbers."""
    return "seed" in run.options


def soon(find: Callable[[], T], seconds: float = 300) -> T:
    """Waits for a true value and returns it."""
    deadline = time.monotonic() + seconds
    while not (found := find()):
        assert time.monotonic() < deadline, f"not within {seconds:g} seconds"
        time.sleep(0.01)
    return found


def small(program: str) -> dict[str, object]:
    """Options with which a program, also one of the user, runs for a fraction of a second."""
    named = NAMED.get(
        program, {name: GENERAL[name] for name in GENERAL if name in options_of_programs()[program]}
    )
    return named | ({"seed": 1} if "seed" in options_of_programs()[program] else {})


def command_line(program: str, options: dict) -> list[str]:
    """Command of a program with small options, changed by `options`. True gives a flag; None omits an
    option."""
    words = [str(ROOT / "build/bin" / program)]
    for name, value in {**small(program), **options}.items():
        if value is True:
            words.append(f"--{name}")
        elif value is not None:
            words += [f"--{name}", str(value)]
    return words


def simulate(simulator: str, **options: object) -> np.ndarray:
    """Table printed by a reference simulator of tests/cpp/reference, as numbers. Raises
    CalledProcessError."""
    dashed = {name.replace("_", "-"): value for name, value in options.items()}
    program = ROOT / "build/bin/reference_simulator"
    if not program.exists():  # `make build` compiles no tests
        subprocess.run(["bash", "workflow/pipeline/environment/build.sh", program.name], cwd=ROOT, check=True)
    command = [str(program), simulator, *arguments(dashed)]
    printed = subprocess.check_output(command, text=True)
    return np.array([line.split() for line in printed.splitlines()], dtype=float)


def agree(*scores: np.ndarray) -> bool:
    """Whether the largest score is below the bound for as many independent normal ones. Correlations only
    make it smaller."""
    every = np.concatenate([np.ravel(each) for each in scores])
    return bool(np.abs(every).max() < norm.isf(1e-4 / 2 / every.size))


def spread_accepted(values: np.ndarray, errors: np.ndarray, replicas: int, level: float) -> bool:
    """Chi-square of values [seed] about their weighted mean at a two-sided level. Errors estimated from R
    replicas make the sum of squared Student variables: each has mean (R-1)/(R-3), not 1, which the bounds
    allow for."""
    weights = errors**-2
    statistic = np.sum(weights * (values - np.average(values, weights=weights)) ** 2)
    low, high = chi2.ppf([level / 2, 1 - level / 2], len(values) - 1)
    return bool(low < statistic < (replicas - 1) / (replicas - 3) * high)


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """Function that runs a program in an empty folder. Options are keywords with underscores instead of
    dashes."""

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
def over_seeds(program: Program, tmp_path: Path) -> OverSeeds:
    """Function that runs a program once with each of a number of seeds. Returns means and standard errors
    of each named quantity as arrays [seed, ...]. It reads nothing else, as loading a whole result takes as
    long as a small run."""

    def run(name: str, seeds: int, *quantities: str, **options: object) -> dict[str, np.ndarray]:
        found: dict[str, list] = {quantity: [] for quantity in quantities}
        for seed in range(seeds):
            done = program(name, seed=seed, **options)
            assert done.returncode in (0, 4), done.stderr  # 4: the target quantity has no error
            with h5py.File(tmp_path / "out.h5") as file:
                for quantity, pairs in found.items():
                    pairs.append(
                        [file[f"results/{quantity}/{kind}"][()] for kind in ("mean", "standard_error")]
                    )
        return {quantity: np.moveaxis(np.array(pairs), 1, 0) for quantity, pairs in found.items()}

    return run


@pytest.fixture
def measure(program: Program, tmp_path: Path) -> Measure:
    """Function that runs a program and loads its result. allowed: exit statuses that are no failure."""

    def run(name: str, allowed: tuple[int, ...] = (0,), **options: object) -> Result:
        done = program(name, **options)
        assert done.returncode in allowed, done.stderr
        return load(tmp_path / "out.h5")

    return run

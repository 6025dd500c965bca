"""Bad input: exit status 2, no file, and one line that names the option.
tests/cpp/program/options_test.cpp has values that are not allowed by themselves."""

import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import ROOT, Program

BAD: dict[str, list[dict[str, object]]] = {  # options; the first is named
    "persistence": [
        {"gamma": 4.1, "cells": 4},
        {"cells": 100_000_000, "particles-per-cell": 100_000_000},
        {"reversal-probability": 0.1},
        {"reversal-probability": None, "rule": "reversal"},
        {"output": None},
        {"seed": None},  # a default would give two runs of a user equal random numbers
        {"output": "-"},
    ],
    "displacement": [
        {"fit-decades": 1.5, "decades": 1},
        {"replicas": 10**8},
        {"decades": 15, "observation-time": 1e-3, "relaxation-time": 100},
    ],
    "energy_pulse": [{"times": "0.02,0.01"}, {"pulse-cells": 22}, {"cells": 6}, {"relaxation-time": 1e12}],
    "heat_current": [
        {"times": "1e-9,1"},
        {"times": "1,2", "observation-time": 1.5},
        {"times": "1,2.5"},
        {"times": "1"},
        {"fugacity": 1e12},
    ],
    "conductivity": [
        {"relaxation-time": "5N"},
        {"cell-length": 1e-11, "observation-time": 1000},
        {"nu-left": 1e12},
    ],
    "momentum_flux": [{"momentum-bins": 21}],
    "particle_count": [{"times": "10"}],
    "boltzmann": [
        {"gamma": "N"},
        {"positions": "0.5", "cells": 4},
        {"nu-left": 0, "nu-right": 0},
        {"rule": "random-direction"},
    ],
}


@pytest.mark.parametrize(("name", "options"), [(name, case) for name, cases in BAD.items() for case in cases])
def test_bad_options_are_refused_in_one_line(
    program: Program, tmp_path: Path, name: str, options: dict[str, object]
) -> None:
    result = program(name, **options)
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith(f"{name}: error: ")
    assert result.stderr.count("\n") == 1
    assert f"--{next(iter(options))}" in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("option", ["--describe", "--help", "--version"])
def test_an_output_that_is_full(option: str) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [ROOT / "build/bin/persistence", option],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr.startswith("persistence: error: the standard output ")
    assert done.stderr.count("\n") == 1

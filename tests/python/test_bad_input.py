"""Bad input: exit status 2, no file, and one line that names the option. tests/cpp/program/options_test.cpp has values that are
not allowed by themselves."""

import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import Program

BAD: dict[str, list[dict[str, object]]] = {  # options; the first is named
    "persistence": [
        {"sigma": "-1.0000001"},
        {"gamma": 4.1, "cells": 4},
        {"cells": 100_000_000, "particles-per-cell": 100_000_000},
        {"rule": "plastic"},
        {"output": None},
    ],
    "displacement": [{"decades": 15, "observation-time": 1e-3, "relaxation-time": 100}],
    "ageing": [{"fit-decades": 1.5, "decades": 1}, {"replicas": 10**8}],
    "energy_pulse": [{"times": "0.02,0.01"}, {"pulse-cells": 22}, {"cells": 6}, {"relaxation-time": 1e12}],
    "correlation": [{"times": "1e-9,1"}, {"times": "1,2", "observation-time": 1.5}, {"cells": 25}, {"sigma": 1}],
    "heat_current": [{"times": "1,2.5"}, {"fit-from": 3}, {"fugacity": 1e12}],
    "conductivity": [{"relaxation-time": "5N"}, {"cell-length": 1e-11, "observation-time": 1000}, {"nu-left": 1e12}],
    "momentum_flux": [{"momentum-bins": 21}],
    "particle_count": [{"times": "10"}],
    "boltzmann": [{"gamma": "N"}, {"positions": "0.5", "cells": 4}, {"nu-left": 0, "nu-right": 0}],
}  # fmt: skip


def check_refusal(result: subprocess.CompletedProcess, name: str, word: str) -> None:
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith(f"{name}: error: ")
    assert result.stderr.count("\n") == 1
    assert word in result.stderr


@pytest.mark.parametrize(("name", "options"), [(name, case) for name, cases in BAD.items() for case in cases])
def test_refused(program: Program, tmp_path: Path, name: str, options: dict[str, object]) -> None:
    check_refusal(program(name, **options), name, f"--{next(iter(options))}")
    assert list(tmp_path.iterdir()) == []


def test_cost_file_that_cannot_be_written(persistence: Program, tmp_path: Path) -> None:
    (tmp_path / "out.cost.json").mkdir()
    check_refusal(persistence(), "persistence", "out.cost.json")
    assert [path.name for path in tmp_path.iterdir()] == ["out.cost.json"]

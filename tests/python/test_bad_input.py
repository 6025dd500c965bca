"""Bad input: exit status 2, no file, and one line with the problem, its reason and the remedy."""

import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import Program

# One crossing carries an energy of 1e250 in a window of 1e-60.
VIOLENT = {"temperature-left": 1e250, "temperature-right": 2e250, "nu-left": 1, "nu-right": 1, "cell-length": 1e65,
           "relaxation-time": 0, "observation-time": 1e-60}  # fmt: skip

BAD: dict[str, list[tuple[dict[str, object], str]]] = {
    "persistence": [
        *(({"sigma": value}, "[-1, 1]") for value in ("2", "-1.0000001")),
        ({"cells": "0"}, "[1, "),
        ({"cells": 4, "gamma": 4.1}, "--gamma exceeds --cells"),
        ({"cells": 100_000_000, "particles-per-cell": 100_000_000}, "smaller chain"),
        ({"particles-per-cell": "0"}, "[1, "),
        *(({"temperature": value}, "greater than 0") for value in ("-1", "0")),
        ({"temperature": 1e301}, "--temperature"),
        ({"scatterer-temperature": "-0.1"}, "at least 0"),
        ({"cell-length": "0"}, "greater than 0"),
        ({"relaxation-time": "-1"}, "at least 0"),
        ({"observation-time": "0"}, "greater than 0"),
        ({"observation-time": 1e300}, "--observation-time"),
        ({"replicas": "0"}, "[1, "),
        ({"threads": "0"}, "[1, "),
        ({"target-error": "-0.1"}, "at least 0"),
        ({"target-error": 0.1, "target-absolute": 0.1}, "--target-absolute"),
        ({"progress": "loud"}, "auto, bar, log, none"),
        ({"output": None}, "FILE.h5"),
    ],
    "displacement": [
        ({"decades": "0"}, "[1, 15]"),
        ({"decades": 15, "observation-time": 1e-3, "relaxation-time": 100}, "--decades"),
        ({"observation-time": 1e100, "cell-length": 1e100}, "displacement at the first time"),
    ],
    "ageing": [({"decades": 1, "fit-decades": 1.5}, "--fit-decades")],
    "energy_pulse": [
        ({"times": "0.02,0.01"}, "ascend"),
        ({"times": "0.02,x"}, "'0.02,x'"),
        ({"times": "0.02"}, "Add another"),
        ({"pulse-cells": 22}, "--pulse-cells exceeds --cells"),
        ({"pulse-cells": 2}, "--pulse-cells is even"),
        ({"cells": 6}, "--cells is less than 7"),
        ({"gamma": "M"}, "'M'"),
        ({"gamma": "0"}, "greater than 0"),
        ({"pulse-energy": 1e301}, "--pulse-energy, --scatterer-temperature: the highest temperature"),
        ({"relaxation-time": 1e9}, "thermal flights"),
    ],
    "correlation": [
        ({"times": "0.2,0.3"}, "whole multiple"),
        ({"times": "1e-9,1"}, "whole multiple"),
        ({"times": "1"}, "Add another"),
        ({"times": "1,2", "observation-time": 1.5}, "--observation-time"),
        ({"cells": 5}, "Choose at least"),
        ({"cells": 25}, "--cells: sound travels around the ring within the last of --times. Choose at least"),
        ({"sigma": 1}, "--rule, --sigma: momentum is not conserved"),
        ({"fugacity": 0}, "--fugacity"),
    ],
    "heat_current": [
        ({"times": "1,2.5"}, "whole multiple"),
        ({"times": "1,20", "cells": 200}, "--times goes beyond --observation-time"),
        ({"fit-from": 3}, "--fit-from leaves fewer than two times"),
        ({"fugacity": 1e12}, "more than 1e9 particles"),
        ({"fugacity": 0}, "--fugacity"),
    ],
    "conductivity": [
        ({"observation-time": "0N"}, "followed by N or N^2"),
        ({"relaxation-time": 1e5, "observation-time": 1e-6}, "--observation-time"),
        ({"cell-length": "2/N"}, "1/N"),
        ({"observation-time": 1000, "cell-length": 1e-9}, "thermal flights"),
        ({"nu-left": -1}, "at least 0"),
        ({"nu-left": 1e12}, "particles inside"),
        ({"temperature-left": 0}, "greater than 0"),
        ({"start": "tepid"}, "empty, warm"),
        ({"nu-left": 2e-150, "temperature-left": 1e-300}, "--temperature-left"),
        (VIOLENT, "the rate of crossings times the temperature"),
    ],
    "momentum_flux": [
        ({"momentum-bins": 21}, "--momentum-bins is odd"),
        ({"momentum-max": "1e308"}, "the width of a bin"),
        ({"temperature-left": 1e150, "cell-length": 1e73}, "[1e-140, 1e+140]"),
        ({"cells": 10**8, "cell-length": 1, "momentum-bins": 10**5}, "--cells"),
    ],
    "steady_profile": [
        ({"momentum-max": 0}, "--momentum-max"),
        ({"momentum-max": "1e-320"}, "the width of a bin"),
        (VIOLENT, "the rate of crossings times the temperature"),
    ],
    "particle_count": [
        ({"times": "10"}, "later times"),
        ({"cells": 4, "gamma": 4.1}, "--gamma exceeds --cells"),
        (
            {"momentum-max": 1e200, "times": "0.1,1", "cell-length": 1e-145, "nu-left": 0, "nu-right": 0,
             "temperature-left": 1e-280, "temperature-right": 1e-280},
            "--momentum-max, --times, --cell-length: the number of cells that the fastest particle passes",
        ),
    ],
    "boltzmann": [
        ({"gamma": "N"}, "Give --cells"),
        ({"gamma": -1}, "[0, 1000]"),
        ({"gamma": 1001}, "[0, 1000]"),
        ({"coarsening": 5}, "[0, 4]"),
        ({"sigma": 1}, "[-0.99, 0.99]"),
        ({"momentum-max": "1e308"}, "the width of a bin"),
        ({"momentum-max": "1e-12"}, "the hotter reservoir's thermal momentum"),
        ({"momentum-bins": 3}, "--momentum-bins is odd"),
        ({"cells": 0}, "or continuum"),
        ({"cells": 2.5}, "whole number"),
        ({"cells": 4, "gamma": 5}, "probability"),
        ({"cells": 4, "positions": "0.5"}, "bonds"),
        ({"positions": "0.5,0.2"}, "ascend"),
        ({"positions": "0.5,1.2"}, "[0, 1]"),
        ({"nu-left": 0, "nu-right": 0}, "no particles"),
        ({"temperature-left": 0}, "greater than 0"),
        ({"temperature-right": 1e150}, "--temperature-right"),
    ],
}  # fmt: skip


def check_refusal(result: subprocess.CompletedProcess, name: str, *words: str) -> None:
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith(f"{name}: error: ")
    assert result.stderr.count("\n") == 1
    for word in words:
        assert word in result.stderr


@pytest.mark.parametrize(
    ("name", "options", "words"), [(name, *case) for name, cases in BAD.items() for case in cases]
)
def test_refused(program: Program, tmp_path: Path, name: str, options: dict, words: str) -> None:
    """The message begins with the first of the options."""
    check_refusal(program(name, **options), name, words, f"--{next(iter(options))}")
    assert list(tmp_path.iterdir()) == []


def test_cost_file_that_cannot_be_written(persistence: Program, tmp_path: Path) -> None:
    (tmp_path / "out.cost.json").mkdir()
    check_refusal(persistence(), "persistence", "out.cost.json", "Name a file")
    assert [path.name for path in tmp_path.iterdir()] == ["out.cost.json"]

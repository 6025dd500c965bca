"""The observables of the open chain with extreme options, and with such as they refuse."""

from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import Program
from tests.python.open_chain import QUANTITIES, UNUSED, run


def scaled(temperature: float) -> dict[str, float]:
    """Options with baths at this temperature and all rates and times scaled by the thermal speed."""
    speed = np.sqrt(temperature / 100)
    baths = {"temperature_left": temperature, "temperature_right": temperature}
    baths |= {"nu_left": 200 * speed, "nu_right": 200 * speed}
    return baths | {"relaxation_time": 5 / speed, "observation_time": 10 / speed}


SLOW, FAST = scaled(1e-135), scaled(1e130)


@pytest.mark.parametrize(
    "options",
    [
        {"sigma": 0.999},
        {"sigma": -0.999},
        {"sigma": 1},
        {"temperature_left": 1, "temperature_right": 1e4},
        {"nu_right": 0},
        {"nu_left": 0, "nu_right": 0},
        {"cells": 1},
        {"gamma": 0},
        {"gamma": 1e-300},
        SLOW,
        FAST,
    ],
)
@pytest.mark.parametrize("name", QUANTITIES)
def test_extremes(program: Program, tmp_path: Path, name: str, options: dict) -> None:
    """Results are finite and plausible, or NaN if there is nothing to measure."""
    if name == "particle_count":
        options = {**options, "times": "2,10" if "relaxation_time" not in options else
                   f"{options['relaxation_time']},{options['observation_time']}"}  # fmt: skip
        options = {key: value for key, value in options.items() if not key.endswith("_time")}
    result = run(program, tmp_path, name, **{"cells": 3, "replicas": 20, **options})
    for quantity in result.quantities.values():
        assert not np.isinf(quantity.mean).any()
    if name == "steady_profile" and options.get("nu_left") != 0 and "gamma" not in options:
        assert np.isfinite(result["temperature_particle"].mean).all()
        assert (result["density"].mean >= 0).all()


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("conductivity", {"observation_time": "0N"}, ["--observation-time", "followed by N or N^2"]),
        ("conductivity", {"cell_length": "2/N"}, ["--cell-length", "1/N"]),
        ("conductivity", {"nu_left": -1}, ["--nu-left", "at least 0"]),
        ("conductivity", {"temperature_left": 0}, ["--temperature-left", "greater than 0"]),
        ("conductivity", {"start": "tepid"}, ["--start", "empty", "warm"]),
        ("momentum_flux", {"momentum_bins": 21}, ["--momentum-bins", "odd", "even number"]),
        ("steady_profile", {"momentum_max": 0}, ["--momentum-max"]),
        *(
            (name, {"momentum_max": value}, ["--momentum-max", "the width of a bin", "Choose other values"])
            for name in ("momentum_flux", "steady_profile", "particle_count")
            for value in ("1e308", "1e-320")
        ),
        (
            "particle_count",
            {
                "nu_left": 0,
                "nu_right": 0,
                "temperature_left": 1e-280,
                "temperature_right": 1e-280,
                "cell_length": 1e-145,
                "times": "0.1,1",
                "momentum_max": 1e200,
            },
            [
                "--momentum-max, --times, --cell-length",
                "the number of cells that the fastest particle passes",
            ],
        ),
        ("particle_count", {"times": "10"}, ["--times", "later times"]),
        (
            "conductivity",
            scaled(1e-300),
            ["--nu-left", "--temperature-left", "rate times the lowest", "units"],
        ),
        ("momentum_flux", scaled(1e150), ["--temperature-left", "1e+150", "[1e-140, 1e+140]", "units"]),
    ],
)
def test_bad_input(program: Program, tmp_path: Path, name: str, options: dict, words: list[str]) -> None:
    if name == "particle_count":
        options = {**options, "relaxation_time": None, "observation_time": None}
    result = program(name, **UNUSED | options)
    assert result.returncode == 2
    for word in words:
        assert word in result.stderr
    assert list(tmp_path.iterdir()) == []

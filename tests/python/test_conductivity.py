"""Conductivities that are not defined and windows that are not stationary are reported in the last lines."""

from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import Program
from workflow.lib.load import load


def test_a_window_that_is_not_stationary_is_reported(program: Program) -> None:
    options = {"cells": 16, "replicas": 32, "seed": 1, "progress": "log"}
    drifting = program("conductivity", **options, start="empty", relaxation_time=0, observation_time=2)
    assert drifting.returncode == 0
    last = drifting.stderr.splitlines()[-1]
    assert last.startswith("conductivity: not stationary: the p-value of no drift is ")
    assert "--relaxation-time" in last
    stationary = program("conductivity", **options, relaxation_time=50, observation_time=50)
    assert "stationary" not in stationary.stderr
    few = program("conductivity", **options | {"replicas": 1}, relaxation_time=50, observation_time=50)
    assert few.stderr.splitlines()[-1].endswith("choose more --replicas")


@pytest.mark.parametrize(
    ("options", "remedy"),
    [
        ({"nu_left": 0, "nu_right": 0}, "--nu-right"),
        ({"temperature_left": 100, "temperature_right": 100}, "--temperature-right"),
        ({"cells": 1}, "--cells"),
        ({"sigma": 0, "rule": "reversal", "reversal_probability": 0}, "--sigma"),
    ],
)
def test_a_conductivity_that_is_not_defined(
    program: Program, tmp_path: Path, options: dict, remedy: str
) -> None:
    done = program("conductivity", **options, progress="log")
    assert done.returncode == 0
    [line] = [line for line in done.stderr.splitlines() if "kappa" in line]
    assert line.startswith("conductivity: kappa is not defined: ")
    assert remedy in line
    result = load(tmp_path / "out.h5")
    for name in ("kappa", "kappa_plain", "kappa_printed", "kappa_particle"):
        assert np.isnan(result[name].mean)
    assert result.provenance["target_quantity"] == "energy_current"
    assert np.isfinite(result["energy_current"].mean)


def test_a_difference_of_temperatures_that_is_noise_gives_no_conductivity(
    program: Program, tmp_path: Path
) -> None:
    """No particle scatters."""
    options = {"gamma": 1e-20, "cells": 5, "relaxation_time": 5, "observation_time": 20, "replicas": 32}
    done = program("conductivity", **options, progress="log")
    assert done.returncode == 0
    assert "kappa is not defined: T_N - T_1" in done.stderr
    result = load(tmp_path / "out.h5")
    assert np.isnan(result["kappa"].mean)
    assert np.isfinite(result["temperature_last"].mean)

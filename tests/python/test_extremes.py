"""Every program over the whole domain of its options: a plausible result, or an error message with a reason."""

import os
import resource
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.python.conftest import ROOT
from tests.python.drawn_options import PROGRAMS, SIGMAS
from workflow.lib.described import described
from workflow.lib.load import NOT_REACHED, Result, load

DRAWN = settings(
    derandomize=True, database=None, deadline=None, max_examples=12, suppress_health_check=list(HealthCheck)
)
MEMORY = 2 << 30  # bytes; a run that needs more must be rejected
REPLICAS = 3


def limit_memory() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def execute(name: str, options: dict[str, object]) -> tuple[int, str, Result | None]:
    """Exit status, standard error output, and the result if there is one."""
    words = [str(ROOT / "build/bin" / name), "--output", "out.h5", "--progress", "none"]
    if name != "boltzmann":
        options = {"replicas": REPLICAS, "threads": 1} | options
    for key, value in options.items():
        words += [f"--{key}"] if value is True else [f"--{key}", str(value)]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            words, cwd=folder, env={"PATH": os.defpath}, capture_output=True, text=True, timeout=20,
            check=False, preexec_fn=limit_memory,
        )  # fmt: skip
        output = Path(folder) / "out.h5"
        return done.returncode, done.stderr, load(output) if output.exists() else None


# Quantities that are NaN if there is nothing to measure (docs/format.md).
MAY_BE_NAN = {
    "current_correlation",  # NaN if the currents do not vary
    "alpha_relative", "alpha_difference", "density_slope", "density_excess", "temperature_difference",
    "rate_right_deviation", "rate_left_deviation", "drift_p_value", "exponent_by_cut", "exponent_spread", "front", "front_exponent", "kurtosis", "local_slope",
    "logarithmic_power", "momentum_drift", "plateau", "square", "temperature_particle", "peak", "peak_position",
    "peak_speed", "peak_width", "centroid", "sound_speed", "damping_exponent_from", "damping_drift", "local_damping_exponent", "peak_collapse", "centre_share",
}  # fmt: skip


def check_physics(result: Result) -> None:
    for name, quantity in result.quantities.items():
        assert not np.isinf(quantity.mean).any(), name
        no_line = name == "jump" and result.parameters["momentum-bins"] < 4
        if (
            result.converged != NOT_REACHED
            and name not in MAY_BE_NAN
            and not no_line
            and not name.startswith("kappa")
        ):
            assert not np.isnan(quantity.mean).any(), name
        finite = quantity.mean[np.isfinite(quantity.mean)]
        positive = name.startswith(("temperature", "rate", "density", "weighted", "variance"))
        signed = name.endswith(("_drift", "_difference", "_deviation", "_slope", "_excess"))
        if (positive or name.endswith(("particle_energy", "scatterer_energy"))) and not signed:
            assert (finite >= -1e-9 * np.abs(finite).max(initial=0)).all(), name
    drift = result.quantities.get("energy_drift")
    if drift is not None:
        # Worst case: every collision has 14 rounding errors of a velocity, all of the same sign.
        assert drift.mean <= 28 * 2.0**-53 * max(1, result.provenance["events"])
    if "sum_error" in result.quantities:
        assert result["sum_error"].mean <= 1e-10
    if "mu" in result.quantities and result.converged != NOT_REACHED:
        assert 0 <= result["mu"].mean <= 1


@pytest.mark.parametrize("name", described())
def test_right_or_refused(name: str) -> None:
    @DRAWN
    @given(PROGRAMS[name])
    def check(options: dict[str, object]) -> None:
        status, stderr, result = execute(name, options)
        assert status in (0, 2, 3, 4), stderr
        if status in (2, 3):
            assert stderr.startswith(f"{name}: ")
            assert "--" in stderr or "Choose" in stderr
            assert stderr.count("\n") == 1
            assert result is None
            return
        assert stderr == ""
        assert result is not None
        assert (result.converged == NOT_REACHED) == (status == 4)
        target = result.provenance["target_quantity"]
        if status == 0 and target in result.quantities:
            assert np.isfinite(result[target].mean)
        check_physics(result)

    check()


CLOSED = {"cells": 3, "particles-per-cell": 2, "relaxation-time": 0, "gamma": 2}
ENERGIES = {"particle_energy": 4.0, "scatterer_energy": 4.0}
CURRENTS = {"energy_current_plain": 8.0, "particle_current_plain": 2.0, "temperature_first": 4.0}


def same_but_for_units(one: Result, other: Result, units: dict[str, float], k: int) -> None:
    for name, quantity in one.quantities.items():
        if name in units:
            unit = units[name] ** k
            assert other[name].mean == quantity.mean * unit, name
            # Sums of squares are accumulated as roots, which are rounded once more.
            np.testing.assert_allclose(other[name].standard_error, quantity.standard_error * unit, rtol=1e-14)


@settings(DRAWN, max_examples=5)
@given(st.integers(-45, 45), SIGMAS)
def test_temperatures_are_a_matter_of_units(k: int, sigma: float) -> None:
    """A power of two as the unit of velocity leaves results bitwise unchanged."""

    def persistence(power: int) -> Result:
        return execute("persistence", CLOSED | {"sigma": repr(sigma), "temperature": repr(4.0**power),
                                                "observation-time": repr(2.0 ** (3 - power))})[2]  # fmt: skip

    one, other = persistence(0), persistence(k)
    same_but_for_units(one, other, ENERGIES | {"mu": 1.0}, k)


@settings(DRAWN, max_examples=5)
@given(st.integers(-30, 30), SIGMAS)
def test_baths_are_a_matter_of_units(k: int, sigma: float) -> None:
    def conductivity(power: int) -> Result:
        rate, time = repr(20 * 2.0**power), repr(2.0**-power)
        return execute("conductivity", {"cells": 3, "sigma": repr(sigma), "start": "empty", "nu-left": rate,
                                        "nu-right": rate, "temperature-left": repr(4.0**power),
                                        "temperature-right": repr(1e8 * 4.0**power), "relaxation-time": 0,
                                        "observation-time": time})[2]  # fmt: skip

    same_but_for_units(conductivity(0), conductivity(k), CURRENTS, k)


@pytest.mark.parametrize(("cells", "time", "limit"), [(1, 1e5, 4e-16), (10**6, 0.05, 3e-14)])
def test_smallest_and_largest_chains_conserve_energy_and_momentum(
    cells: int, time: float, limit: float
) -> None:
    chain = {"cells": cells, "particles-per-cell": 1, "relaxation-time": 0, "observation-time": time}
    result = execute("persistence", {**chain, "replicas": 2})[2]
    assert max(float(result[name].mean) for name in ("energy_drift", "momentum_drift")) < limit


@pytest.mark.parametrize("options", [{"gamma": 0}, {"gamma": 1e-10}, {"nu-left": 0}])
def test_kinetic_currents_are_constant_in_extreme_limits(options: dict[str, object]) -> None:
    result = execute("boltzmann", {"gamma": 1, "coarsening": 2, "target-error": 1e-6, **options})[2]
    assert result["current_spread"].mean < 2e-15


def test_an_iteration_that_does_not_converge_is_a_numerical_failure() -> None:
    baths = {"nu-left": 0, "nu-right": 1, "temperature-left": 1, "temperature-right": 1}
    status, stderr, result = execute("boltzmann", {"sigma": -0.99, "gamma": 50, "coarsening": 4, **baths})
    assert (status, result) == (3, None)
    assert stderr.startswith("boltzmann: numerical failure: Newton's iteration")

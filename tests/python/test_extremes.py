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
from workflow.lib.load import NOT_REACHED, Result, load

DRAWN = settings(
    derandomize=True, database=None, deadline=None, max_examples=20, suppress_health_check=list(HealthCheck)
)
MEMORY = 2 << 30  # bytes; a run that needs more must be rejected
REPLICAS = 3

LIMITS = [1 - 10.0**-k for k in range(1, 17)]
SIGMAS = st.sampled_from([0.0, 1.0, -1.0, 5e-324, *LIMITS, *(-x for x in LIMITS)]) | st.floats(-1, 1)
# log10 of the number of flights: runs that end soon, and runs that no machine could finish.
FLIGHTS = st.floats(-3, 2) | st.floats(-300, -20) | st.floats(16, 300)


def powers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


def number(exponent: float) -> str:
    """A power of ten as text, which may lie outside the range of a double."""
    whole = int(np.floor(exponent))
    return f"{10 ** (exponent - whole):.6f}e{whole}"


@st.composite
def closed(draw: st.DrawFn) -> dict[str, object]:
    cells = draw(st.integers(1, 4))
    temperature, length = draw(st.floats(-300, 300)), draw(st.floats(-100, 100) | st.floats(-300, 300))
    flight = length - temperature / 2  # log10 of the time of a thermal flight
    options = {
        "cells": cells,
        "particles-per-cell": draw(st.integers(1, 3)),
        "sigma": repr(draw(SIGMAS)),
        "gamma": draw(st.sampled_from(["N", cells, 0.5, 1e-300])),
        "cell-length": number(length),
        "temperature": number(temperature),
        "scatterer-temperature": draw(
            st.just("0") | st.floats(-20, 4).map(lambda x: number(temperature + x))
        ),
        "relaxation-time": draw(st.just("0") | FLIGHTS.map(lambda x: number(flight + x))),
        "observation-time": number(flight + draw(FLIGHTS)),
    }
    return options | ({"zero-total-momentum": True} if draw(st.booleans()) else {})


@st.composite
def displaced(draw: st.DrawFn) -> dict[str, object]:
    options = draw(closed()) | {"decades": draw(st.sampled_from([1, 6, 15]))}
    return options | ({"random-direction": True} if draw(st.booleans()) else {})


@st.composite
def aged(draw: st.DrawFn) -> dict[str, object]:
    return draw(closed()) | {"decades": draw(st.sampled_from([1, 6, 15])),
                             "fit-decades": draw(st.sampled_from([0.25, 1, 15]))}  # fmt: skip


@st.composite
def pulsed(draw: st.DrawFn) -> dict[str, object]:
    options = draw(closed()) | {"cells": draw(st.integers(6, 9)), "pairs-per-replica": 2}
    options["energy"] = options.pop("temperature")
    pulse = float(options["energy"]) * draw(powers(-6, 3))
    last = options.pop("observation-time")
    options.pop("zero-total-momentum", None)
    mantissa, exponent = last.split("e")
    return options | {"pulse-energy": repr(pulse), "times": f"{mantissa}e{int(exponent) - 1},{last}"}


@st.composite
def correlated(draw: st.DrawFn) -> dict[str, object]:
    options = draw(closed()) | {"cells": draw(st.integers(7, 9))}
    mantissa, exponent = str(options["observation-time"]).split("e")
    return options | {"times": f"{mantissa}e{int(exponent) - 1},{options['observation-time']}"}


@st.composite
def opened(draw: st.DrawFn) -> dict[str, object]:
    cells = draw(st.integers(1, 4))
    temperature, length = draw(st.floats(-292, 292)), draw(st.floats(-100, 100) | st.floats(-300, 300))
    contrast = draw(st.floats(-8, 8))
    flight = length - max(temperature, temperature + contrast) / 2
    last = flight + draw(FLIGHTS)
    # Number of particles injected in all: few, or more than possible.
    rates = st.just("0") | (st.floats(-300, 3) | st.floats(16, 300)).map(lambda x: number(x - last))
    return {
        "cells": cells,
        "sigma": repr(draw(SIGMAS)),
        "gamma": draw(st.sampled_from(["N", cells, 0.5, 0, 1e-300])),
        "cell-length": number(length),
        "nu-left": draw(rates),
        "nu-right": draw(rates),
        "temperature-left": number(temperature),
        "temperature-right": number(temperature + contrast),
        "start": draw(st.sampled_from(["empty", "warm"])),
        "relaxation-time": draw(st.sampled_from(["0", number(last - 1), number(last + 1)])),
        "observation-time": number(last),
    }


@st.composite
def binned(draw: st.DrawFn) -> dict[str, object]:
    options = draw(opened())
    scale = float(options["temperature-left"]) ** 0.5
    options["momentum-max"] = repr(scale * draw(powers(-3, 3) | powers(-100, 100)))
    return options | {"momentum-bins": draw(st.sampled_from([2, 4, 20]))}


@st.composite
def counted(draw: st.DrawFn) -> dict[str, object]:
    options = draw(binned())
    options.pop("relaxation-time")
    last = options.pop("observation-time")
    mantissa, exponent = last.split("e")
    return options | {"times": f"{mantissa}e{int(exponent) - 1},{last}"}


@st.composite
def kinetic(draw: st.DrawFn) -> dict[str, object]:
    temperature = draw(st.floats(-292, 292))
    rate = draw(st.floats(-100, 99))
    rates = st.just("0") | st.floats(-8, 8).map(lambda x: number(rate + x))
    scale = 10 ** (temperature / 2)
    return {
        "sigma": repr(draw(st.sampled_from([-0.99, 0.0, 5e-324, 0.99]) | st.floats(-0.99, 0.99))),
        "gamma": draw(st.sampled_from([0, 1e-300, 1, 50])),
        "nu-left": draw(rates),
        "nu-right": draw(rates),
        "temperature-left": number(temperature),
        "temperature-right": number(temperature + draw(st.floats(-8, 8))),
        "momentum-bins": 4,
        "momentum-max": repr(scale * draw(powers(-3, 3) | powers(-100, 100))),
        "target-error": 1e-3,
        "coarsening": 4,
    }


PROGRAMS = {
    "persistence": closed(),
    "waiting_time": closed(),
    "displacement": displaced(),
    "ageing": aged(),
    "energy_pulse": pulsed(),
    "correlation": correlated(),
    "steady_profile": binned(),
    "momentum_flux": binned(),
    "conductivity": opened(),
    "particle_count": counted(),
    "boltzmann": kinetic(),
}


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


# NaN if there is nothing to measure, as documented in docs/format.md.
MAY_BE_NAN = {
    "current_correlation",  # of currents that do not vary
    "local_centre_exponent",  # of correlations that are not positive
    "alpha_relative", "alpha_difference", "density_slope", "density_excess", "temperature_difference",
    "rate_right_deviation", "rate_left_deviation", "drift_p_value", "exponent_by_cut", "exponent_spread", "front", "front_exponent", "kurtosis", "local_slope",
    "logarithmic_power", "momentum_drift", "plateau", "square", "temperature_particle", "peak", "peak_position",
    "peak_speed", "damping_exponent_from", "local_damping_exponent", "peak_collapse", "centre_share",
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
        known = quantity.mean[np.isfinite(quantity.mean)]
        positive = name.startswith(("temperature", "rate", "density", "weighted", "variance"))
        signed = name.endswith(("_drift", "_difference", "_deviation", "_slope", "_excess"))
        if (positive or name.endswith(("particle_energy", "scatterer_energy"))) and not signed:
            assert (known >= -1e-9 * np.abs(known).max(initial=0)).all(), name
    drift = result.quantities.get("energy_drift")
    if drift is not None:
        # Worst case: every collision has 14 rounding errors of a velocity, all of the same sign.
        assert drift.mean <= 28 * 2.0**-53 * max(1, result.provenance["events"])
    if "sum_error" in result.quantities:
        assert result["sum_error"].mean <= 1e-10
    if "mu" in result.quantities and result.converged != NOT_REACHED:
        assert 0 <= result["mu"].mean <= 1


@pytest.mark.parametrize("name", PROGRAMS)
def test_right_or_refused(name: str) -> None:
    @DRAWN
    @given(PROGRAMS[name])
    def check(options: dict[str, object]) -> None:
        status, said, result = execute(name, options)
        assert status in (0, 2, 3, 4), said
        if status in (2, 3):
            assert said.startswith(f"{name}: ")
            assert "--" in said or "Choose" in said
            assert said.count("\n") == 1
            assert result is None
            return
        assert said == ""
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


@settings(DRAWN, max_examples=20)
@given(st.integers(-490, 480), SIGMAS)
def test_temperatures_are_a_matter_of_units(k: int, sigma: float) -> None:
    """A power of two as the unit of velocity leaves results bitwise unchanged."""

    def persistence(power: int) -> Result:
        return execute("persistence", CLOSED | {"sigma": repr(sigma), "temperature": repr(4.0**power),
                                                "observation-time": repr(2.0 ** (3 - power))})[2]  # fmt: skip

    one, other = persistence(0), persistence(k)
    same_but_for_units(one, other, ENERGIES | {"mu": 1.0}, k)


@settings(DRAWN, max_examples=20)
@given(st.integers(-300, 300), SIGMAS)
def test_baths_are_a_matter_of_units(k: int, sigma: float) -> None:
    def conductivity(power: int) -> Result:
        rate, time = repr(20 * 2.0**power), repr(2.0**-power)
        return execute("conductivity", {"cells": 3, "sigma": repr(sigma), "start": "empty", "nu-left": rate,
                                        "nu-right": rate, "temperature-left": repr(4.0**power),
                                        "temperature-right": repr(1e8 * 4.0**power), "relaxation-time": 0,
                                        "observation-time": time})[2]  # fmt: skip

    same_but_for_units(conductivity(0), conductivity(k), CURRENTS, k)


@settings(DRAWN, max_examples=8)
@given(st.floats(-0.99, 0.99), st.floats(0, 10), st.floats(0.01, 100))
def test_mirrored_baths_mirror_the_kinetic_equation(sigma: float, gamma: float, contrast: float) -> None:
    def currents(left: int, right: int) -> list[tuple[float, float]]:
        baths = {0: (200, 1), 1: (100, contrast)}
        options = {"sigma": repr(sigma), "gamma": repr(gamma), "coarsening": 3, "target-error": 1e-3}
        for side, bath in (("left", left), ("right", right)):
            options |= {f"nu-{side}": baths[bath][0], f"temperature-{side}": repr(baths[bath][1])}
        status, said, result = execute("boltzmann", options)
        assert status in (0, 4), said
        pairs = [result[name] for name in ("particle_current", "energy_current")]
        return [(float(pair.mean), float(pair.discretisation_error)) for pair in pairs]

    for (one, error), (other, other_error) in zip(currents(0, 1), currents(1, 0), strict=True):
        assert abs(one + other) <= error + other_error


REFUSED = [
    ("persistence", {"observation-time": 1e300}, "--observation-time"),
    ("persistence", {"temperature": 1e301}, "--temperature"),
    ("persistence", {"temperature": 1e-301}, "--temperature"),
    ("persistence", {"cells": 4, "gamma": 4.1}, "--gamma exceeds --cells"),
    ("energy_pulse", {"cells": 9, "gamma": 1e300}, "--gamma exceeds --cells"),
    ("particle_count", {"cells": 4, "gamma": 4.1}, "--gamma exceeds --cells"),
    ("ageing", {"decades": 1, "fit-decades": 1.5}, "--fit-decades"),
    ("displacement", {"decades": 2, "fit-decades": 3}, "--fit-decades"),
    ("displacement", {"decades": 15, "observation-time": 1e-3, "relaxation-time": 100}, "--decades"),
    ("displacement", {"cell-length": 1e100, "observation-time": 1e100}, "displacement at the first time"),
    ("conductivity", {"relaxation-time": 1e5, "observation-time": 1e-6}, "--observation-time"),
    ("energy_pulse", {"relaxation-time": 1e9}, "thermal flights"),
    ("conductivity", {"cell-length": 1e-9, "observation-time": 1000}, "thermal flights"),
    ("conductivity", {"nu-left": 1e12}, "particles inside"),
    ("momentum_flux", {"temperature-left": 1e150, "cell-length": 1e73}, "--temperature-left"),
    ("momentum_flux", {"cells": 10**8, "cell-length": 1, "momentum-bins": 10**5}, "--cells"),
    ("boltzmann", {"temperature-right": 1e150}, "--temperature-right"),
]


@pytest.mark.parametrize(("name", "options", "word"), REFUSED)
def test_refused(name: str, options: dict[str, object], word: str) -> None:
    status, said, result = execute(name, options)
    assert (status, result) == (2, None)
    assert word in said
    assert "Choose" in said


def test_an_iteration_that_does_not_converge_is_a_numerical_failure() -> None:
    baths = {"nu-left": 0, "nu-right": 1, "temperature-left": 1, "temperature-right": 1}
    status, said, result = execute("boltzmann", {"sigma": -0.99, "gamma": 50, "coarsening": 4, **baths})
    assert (status, result) == (3, None)
    assert said.startswith("boltzmann: numerical failure: Newton's iteration")

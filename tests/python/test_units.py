"""The units that files declare for every number of every program.

Physics does not depend on units: with momenta and lengths scaled, every program must find the same numbers in
other units. For powers of two the random numbers and the events are the same, so that all results agree to
rounding.
"""

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from tests.python.scale import ROUNDING, agree, factor, other_option
from workflow.lib.load import Result, load
from workflow.lib.units import parse
from workflow.pipeline.program import execute
from workflow.pipeline.sources import programs

CLOSED = {
    "cells": 5,
    "particles-per-cell": 3,
    "cell-length": 1.3,
    "relaxation-time": 5,
    "observation-time": 10,
    "replicas": 4,
}
# No time before the first collisions: exponents of ballistic motion have errors of rounding.
TAGGED = CLOSED | {"decades": 2}
PULSE = {"cells": 41, "particles-per-cell": 20, "times": "0.01,0.02,0.03,0.04", "replicas": 8}
EQUILIBRIUM = {"cells": 20, "observation-time": 8, "times": "0.5,1,2,4", "replicas": 8}
OPEN = {"cells": 5, "cell-length": 0.3, "relaxation-time": 0.5, "observation-time": 20, "replicas": 16}
FILLING = {"cells": 5, "times": "10,30,100", "replicas": 4}
CASES = {
    "persistence": ("persistence", CLOSED),
    "persistence, rare": ("persistence", CLOSED | {"gamma": 2.6, "scatterer-temperature": 400}),
    "waiting_time": ("waiting_time", CLOSED),
    "waiting_time, rare": ("waiting_time", CLOSED | {"gamma": 2.6, "tail-from": 100}),
    "displacement": ("displacement", TAGGED),
    "displacement, rare": ("displacement", TAGGED | {"gamma": 2.6, "zero-total-momentum": True}),
    "displacement, random": ("displacement", TAGGED | {"rule": "random-direction"}),
    "heat_current": ("heat_current", EQUILIBRIUM),
    "heat_current, random": ("heat_current", EQUILIBRIUM | {"rule": "random-direction"}),
    "energy_pulse": ("energy_pulse", PULSE),
    "energy_pulse, rare": ("energy_pulse", PULSE | {"gamma": 1.3, "relaxation-time": 0.1}),
    "conductivity": ("conductivity", OPEN),
    "conductivity, rare": ("conductivity", OPEN | {"gamma": 1.3}),
    "steady_profile": ("steady_profile", OPEN),
    "steady_profile, rare": ("steady_profile", OPEN | {"gamma": 1.3}),
    "steady_profile, random": ("steady_profile", OPEN | {"rule": "random-direction"}),
    "momentum_flux": ("momentum_flux", OPEN),
    "momentum_flux, rare": ("momentum_flux", OPEN | {"gamma": 1.3, "start": "empty"}),
    "particle_count": ("particle_count", FILLING),
    "particle_count, rare": ("particle_count", FILLING | {"gamma": 1.7}),
    "boltzmann": ("boltzmann", {}),
    "boltzmann, cells": ("boltzmann", {"cells": 5, "gamma": "N"}),
}
COUNTS = {"mu/mean", "total_number/mean"}  # ratios of counts, without rounding


def call(program: str, options: dict[str, object]) -> Result:
    seed = {} if program == "boltzmann" else {"seed": 1}
    with TemporaryDirectory() as folder:
        execute(program, options | seed, Path(folder) / "out.h5")
        return load(Path(folder) / "out.h5")


@cache
def measured(case: str) -> tuple[Result, Result]:
    """Results in the default units, and in other ones."""
    program, options = CASES[case]
    plain = call(program, options)
    given_or_not = {
        name.replace("_", "-"): value
        for name, value in plain.parameters.items()
        if name in plain.parameter_units
    }
    scaled = {name: other_option(name, value) for name, value in given_or_not.items()}
    return plain, call(program, options | scaled)


def datasets(result: Result) -> Iterator[tuple[str, np.ndarray, str]]:
    """Path, values and units of every dataset."""
    for name, quantity in result.quantities.items():
        for kind in ("mean", "standard_error", "discretisation_error"):
            if getattr(quantity, kind) is not None:
                yield f"{name}/{kind}", getattr(quantity, kind), quantity.units
        for axis, values in quantity.axes.items():
            yield f"{name}/{axis}", values, quantity.axis_units[axis]


def misfits(plain: Result, scaled: Result, units_of_all: str | None = None) -> set[str]:
    """The datasets that do not scale according to the units of the plain result, or to one
    unit for all."""
    return {
        path
        for (path, values, units), (_, converted, _) in zip(datasets(plain), datasets(scaled), strict=True)
        if not agree(values, converted, factor(units_of_all or units), 0 if path in COUNTS else ROUNDING)
    }


def test_every_program_has_a_case() -> None:
    assert {program for program, _ in CASES.values()} == {*programs()}


@pytest.mark.parametrize("case", CASES)
def test_every_number_scales_as_its_units(case: str) -> None:
    plain, scaled = measured(case)
    assert scaled.provenance["events"] == plain.provenance["events"]
    assert scaled.quantities.keys() == plain.quantities.keys()
    assert misfits(plain, scaled) == set()
    for name, quantity in plain.quantities.items():
        np.testing.assert_array_equal(scaled[name].count, quantity.count)
    relative = [result.provenance["achieved_error"] for result in (plain, scaled)]
    np.testing.assert_allclose(*relative, rtol=ROUNDING)


WRONG = ("1", "length", "time", "1/time", "momentum", "energy", "momentum/time", "length^2 energy")


@pytest.mark.parametrize("program", sorted({program for program, _ in CASES.values()}))
def test_every_wrong_unit_is_found(program: str) -> None:
    """A wrong unit is found in at least one case of the program, as a quantity may be NaN or 0 in the
    other cases."""
    cases = [measured(name) for name, (its_program, _) in CASES.items() if its_program == program]
    for wrong in WRONG:
        found = set().union(*(misfits(plain, scaled, wrong) for plain, scaled in cases))
        other = {path for path, _, units in datasets(cases[0][0]) if parse(units) != parse(wrong)}
        assert {path for path in other if not path.endswith("_error")} <= found, wrong

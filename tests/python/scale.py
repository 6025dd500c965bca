"""Conversion of options and results to other units, and comparison of results in different units."""

from dataclasses import replace
from functools import cache

import numpy as np

from tests.python.described import options_of_programs
from workflow.lib.load import Quantity, Result
from workflow.lib.units import parse

ROUNDING = 1e-9  # relative to the largest value of a dataset


@cache
def option_units() -> dict[str, str]:
    """Declared units of the options of the programs; all others are dimensionless."""
    return {
        name: option["units"]
        for options in options_of_programs().values()
        for name, option in options.items()
        if option.get("units", "1") != "1"
    }


# Factors of the numbers of momenta and of lengths. Units length^L time^T differ by 2^(L + 5T), which has
# another value for all units that could be confused.
MOMENTA, LENGTHS = 1 / 16, 2


def factor(units: str) -> float:
    """Of a number with these units, in the other units."""
    length, time, _ = parse(units)
    return MOMENTA**-time * LENGTHS ** (length + time)


def other_option(name: str, value: object) -> object:
    """An option of the command line in the other units: one or more numbers, or a word."""
    if name not in option_units() or value in ("particles", "1/N"):
        return value
    scale = factor(option_units()[name])
    return ",".join(repr(scale * float(number)) for number in str(value).split(","))


def other_result(result: Result) -> Result:
    """The result in the other units."""

    def scaled(quantity: Quantity) -> Quantity:
        kinds = ("mean", "standard_error", "discretisation_error")
        values = {kind: getattr(quantity, kind) for kind in kinds if getattr(quantity, kind) is not None}
        values = {kind: factor(quantity.units) * each for kind, each in values.items()}
        axes = {name: factor(quantity.axis_units[name]) * axis for name, axis in quantity.axes.items()}
        return replace(quantity, **values, axes=axes)

    quantities = {name: scaled(quantity) for name, quantity in result.quantities.items()}
    options = {
        name: type(value)(other_option(name.replace("_", "-"), value))
        for name, value in result.parameters.items()
    }
    if options.get("cell_length") == "1/N":  # the chain has length 1 in the original units
        options["cell_length"] = LENGTHS / int(options["cells"])
    return replace(result, quantities=quantities, parameters=options)


def agree(plain: np.ndarray, scaled: np.ndarray, scale: float, rounding: float) -> bool:
    """Agreement to rounding, with NaN in the same places."""
    largest = np.max(np.abs(plain[np.isfinite(plain)]), initial=0)
    return np.allclose(scaled / scale, plain, rtol=0, atol=rounding * largest, equal_nan=True)

"""Conversion of options and results to other units, and comparison of results in different units."""

from dataclasses import dataclass, replace
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


@dataclass(frozen=True)
class Scale:
    """Factors by which the numbers of momenta and of lengths change in other units."""

    momenta: float = 1
    lengths: float = 1

    def __call__(self, units: str) -> float:
        length, time, _ = parse(units)
        return self.momenta**-time * self.lengths ** (length + time)

    def option(self, name: str, value: object) -> object:
        """An option of the command line: one or more numbers, or a word."""
        if name not in option_units() or value in ("particles", "1/N"):
            return value
        factor = self(option_units()[name])
        return ",".join(repr(factor * float(number)) for number in str(value).split(","))

    def result(self, result: Result) -> Result:
        """The result converted to these units."""

        def scaled(quantity: Quantity) -> Quantity:
            factor = self(quantity.units)
            kinds = ("mean", "standard_error", "discretisation_error")
            values = {
                kind: factor * getattr(quantity, kind)
                for kind in kinds
                if getattr(quantity, kind) is not None
            }
            axes = {name: self(quantity.axis_units[name]) * axis for name, axis in quantity.axes.items()}
            return replace(quantity, **values, axes=axes)

        quantities = {name: scaled(quantity) for name, quantity in result.quantities.items()}
        options = {
            name: type(value)(self.option(name.replace("_", "-"), value))
            for name, value in result.parameters.items()
        }
        if options.get("cell_length") == "1/N":  # the chain has length 1 in the original units
            options["cell_length"] = self.lengths / int(options["cells"])
        return replace(result, quantities=quantities, parameters=options)


# Units length^L time^T differ by the factor 2^(L + 5T), which has another value for all units that could be
# confused.
OTHER = Scale(momenta=1 / 16, lengths=2)


def agree(plain: np.ndarray, scaled: np.ndarray, factor: float, rounding: float) -> bool:
    """Agreement to rounding, with NaN in the same places."""
    largest = np.max(np.abs(plain[np.isfinite(plain)]), initial=0)
    return np.allclose(scaled / factor, plain, rtol=0, atol=rounding * largest, equal_nan=True)

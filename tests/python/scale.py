"""Other units: what they make of options, of results and of their comparison."""

from dataclasses import dataclass, replace

import numpy as np

from workflow.scripts.columns import OPTIONS
from workflow.scripts.load import Quantity, Result
from workflow.scripts.units import parse

ROUNDING = 1e-9  # relative to the largest value of a dataset


@dataclass(frozen=True)
class Scale:
    """Other units: of momenta and of lengths."""

    momenta: float = 1
    lengths: float = 1

    def __call__(self, units: str) -> float:
        length, time, _ = parse(units)
        return self.momenta**-time * self.lengths ** (length + time)

    def option(self, name: str, value: object) -> object:
        """What stands on the command line: a number, or several of them, each maybe times N; or a word."""
        if name not in OPTIONS or value in ("particles", "1/N"):
            return value
        factor, parts = self(OPTIONS[name]), str(value).split(",")
        return ",".join(f"{factor * float(part.rstrip('N'))!r}{'N' * part.endswith('N')}" for part in parts)

    def result(self, result: Result) -> Result:
        """The same result in these units."""

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
        options = {name: type(value)(self.option(name, value)) for name, value in result.parameters.items()}
        if options.get("cell-length") == "1/N":  # of a chain whose length is 1 in the other units
            options["cell-length"] = self.lengths / int(options["cells"])
        return replace(result, quantities=quantities, parameters=options)


SCALES = (Scale(momenta=8), Scale(lengths=4))


def agree(plain: np.ndarray, scaled: np.ndarray, factor: float, rounding: float) -> bool:
    """NaN only where the other is NaN."""
    largest = np.max(np.abs(plain[np.isfinite(plain)]), initial=0)
    return np.allclose(scaled / factor, plain, rtol=0, atol=rounding * largest, equal_nan=True)

"""What came out of a job, in a few words."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from workflow.lib.fit import with_error
from workflow.lib.load import NOT_REACHED, FormatError, Result, load

LAST = 12  # lines of a log that are shown when a job fails


@dataclass(frozen=True)
class Outcome:
    """text: the target quantity with its error. doubts: why the result is marked, if it is."""

    text: str
    doubts: tuple[str, ...] = ()


def outcome(path: Path) -> Outcome:
    """Of the run that wrote the file; empty if it cannot be read, of which those who read it next will say more."""
    try:
        result = load(path)
    except FormatError:
        return Outcome("")
    return Outcome(_value(result), tuple(_doubts(result)))


def _value(result: Result) -> str:
    """μ = 0.3289(30); of a quantity with many values, the largest error; of a computed one, its discretisation error."""
    name = result.provenance["target_quantity"]
    quantity, achieved = result.quantities.get(name), float(result.provenance["achieved_error"])
    if quantity is None or quantity.mean.size > 1:
        return f"error of {name} {achieved:.2g}"
    error = quantity.error if quantity.discretisation_error is None else quantity.discretisation_error
    return f"{name} = {with_error(float(quantity.mean), float(error))}"


def _doubts(result: Result) -> Iterable[str]:
    if result.converged == NOT_REACHED:
        yield "target error not reached"
    stationary = result.quantities.get("stationary")
    if stationary is not None and np.any(stationary.mean == 0):
        yield "not stationary"


def last_lines(log: Path) -> list[str]:
    """Of a job's log; none if there is none."""
    try:
        return log.read_text(errors="replace").splitlines()[-LAST:]
    except OSError:
        return []

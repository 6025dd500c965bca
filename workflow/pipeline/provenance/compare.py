"""Compares results of SEED or REPLICAS with the results of the quality.

Exit status: 0 if all agree, 1 if not.
"""

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.special import stdtr

from workflow.lib.identity import panel_of
from workflow.lib.load import FormatError, Quantity, Result, load
from workflow.pipeline.plan import Selection, data_path, load_plan, runs_of

SIGNIFICANCE = 1e-4  # p-value of the largest difference in a result
COMPUTED = 1e6  # degrees of freedom of a discretisation error
FEW = 16  # degrees of freedom, below which errors, especially of fitted positions, are too uncertain for a judgement


def error_of_difference(a: Quantity, b: Quantity, shared: bool) -> tuple[np.ndarray, np.ndarray]:
    """Standard error of the difference between two estimates, and its degrees of freedom. shared: with
    one seed the smaller run is a subset of the larger; for equal numbers, the error of one estimate."""
    if a.count is None or b.count is None:
        return np.asarray(a.discretisation_error), np.full(a.mean.shape, COMPUTED)
    few, many = sorted((a, b), key=lambda quantity: quantity.replicas.max(initial=0))
    if not shared:
        return np.hypot(few.error, many.error), 2.0 * few.dof
    # s² (1/m - 1/n) for means of m of n replicas; more where control variates work only with the larger
    # number.
    with np.errstate(divide="ignore", invalid="ignore"):
        variance = many.error**2 * (many.replicas / few.replicas - 1)
    variance = np.maximum(variance, few.error**2 - many.error**2)
    return np.where(many.replicas > few.replicas, np.sqrt(variance), many.error), few.dof


class Difference(NamedTuple):
    """Least probable difference between two results of a run. p: its p-value by Student's distribution
    with Bonferroni's correction; deviation: its size in standard errors."""

    p: float
    deviation: float
    dof: float
    quantity: str

    def __str__(self) -> str:
        judged = f", p = {self.p:.2g}" * (self.dof >= FEW)
        return f"{self.deviation:.2g} standard errors ({self.quantity}){judged}"


class Comparison(NamedTuple):
    """p-value of two results, its description, and whether there are enough replicas to judge it."""

    p: float
    text: str
    judged: bool = True


def largest_difference(one: Result, other: Result) -> Difference:
    """Quantities of different sizes are left out."""
    largest, number = Difference(1.0, 0.0, COMPUTED, ""), 0
    shared = one.parameters.get("seed") == other.parameters.get("seed")
    for name, a in one.quantities.items():
        b = other[name]
        if a.mean.shape == b.mean.shape:
            error, dof = map(np.atleast_1d, error_of_difference(a, b, shared))
            difference = np.atleast_1d(np.abs(a.mean - b.mean))
            usable = (error > 0) & (dof > 0) & np.isfinite(difference)
            deviations, dof = difference[usable] / error[usable], dof[usable]
            for numbers in zip(2 * stdtr(dof, -deviations), deviations, dof, strict=True):
                p, deviation, free = map(float, numbers)
                largest, number = min(largest, Difference(p, deviation, free, name)), number + 1
    return largest._replace(p=min(1.0, number * largest.p))


def equal_values(one: Result, other: Result) -> bool:
    return one.quantities.keys() == other.quantities.keys() and all(
        np.array_equal(array, other[name].arrays()[part], equal_nan=True)
        for name, quantity in one.quantities.items()
        for part, array in quantity.arrays().items()
    )


def compared(former: Path | str, path: Path | str, rerun: bool) -> Comparison:
    """Compares two results. Values of a rerun have to be equal. Raises FormatError, OSError."""
    if Path(former).read_bytes() == Path(path).read_bytes():
        return Comparison(1.0, "equal bytes")
    one, other = load(former), load(path)
    if equal_values(one, other):
        return Comparison(1.0, "equal values, by another compiler or other libraries")
    largest = largest_difference(one, other)
    if not (rerun or largest.quantity):
        raise FormatError(f"{path} has no errors to compare with, as of one replica")
    return Comparison(0.0 if rerun else largest.p, str(largest), rerun or largest.dof >= FEW)


def main(options: argparse.Namespace) -> int:
    """Compares the results of a command with SEED or REPLICAS."""
    selection, found, excluded = Selection.parse(options.quality), [], []
    plan = load_plan(selection.quality)
    for path, run in runs_of(options.plan, options.panels or options.plan, selection.name).items():
        panel = panel_of(path)
        former = data_path(selection.quality, panel, plan[panel].run(run.name))
        if Path(former).is_file():
            try:
                found.append((compared(former, path, rerun=False), path))
            except FormatError as error:
                excluded.append(str(error))
    if excluded:
        print(f"Not compared: {excluded[0]}" + (f"; {len(excluded) - 1} more" if excluded[1:] else ""))
    if not found:
        if not excluded:
            print(f"There are no results of {selection.quality} to compare with")
        return 0
    unlikely = [(one, f"  {path}: {one.text}") for one, path in found if one.p <= SIGNIFICANCE]
    differing, few = ([line for one, line in unlikely if one.judged is judged] for judged in (True, False))
    agreeing = len(found) - len(unlikely)
    print(
        f"{agreeing} of {len(found)} results agree with those of {selection.quality} (p > {SIGNIFICANCE:g})"
    )
    print(f"Least probable difference: {min(found)[0].text}")
    if selection.replicas and selection.seed is None:
        print("The first replicas are shared and not counted as independent: SEED=7 gives independent ones")
    if differing:
        print("Different:", *differing, "Check what differs: make provenance FILE= of both results", sep="\n")
    if few:
        print("Not judged, as errors from few replicas are uncertain:", *few, sep="\n")
    return int(bool(differing))

"""Compares results with others of the same runs: of a rerun, whose values have to be equal, or of another SEED
or number of REPLICAS."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.special import stdtr

from workflow.lib.load import FormatError, Quantity, Result, load
from workflow.pipeline.plan import Plan, runs_of

SIGNIFICANCE = 1e-4  # p-value of the least probable difference
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
    """Least probable of the differences between numbers of two results. p: its p-value by Student's
    distribution; deviation: in standard errors; numbers: how many were compared."""

    p: float
    deviation: float
    quantity: str
    numbers: int


def equal_values(one: Result, other: Result) -> bool:
    return one.quantities.keys() == other.quantities.keys() and all(
        np.array_equal(array, other[name].arrays()[part], equal_nan=True)
        for name, quantity in one.quantities.items()
        for part, array in quantity.arrays().items()
    )


def least_probable(one: Result, other: Result) -> Difference | None:
    """Without quantities of different sizes, and errors from few replicas; None if no number is left."""
    found: list[tuple[float, float, str]] = []
    shared = one.parameters.get("seed") == other.parameters.get("seed")
    for name, a in one.quantities.items():
        b = other[name]
        if a.mean.shape == b.mean.shape:
            error, dof = map(np.atleast_1d, error_of_difference(a, b, shared))
            difference = np.atleast_1d(np.abs(a.mean - b.mean))
            usable = (error > 0) & (dof >= FEW) & np.isfinite(difference)
            deviations = difference[usable] / error[usable]
            p = 2 * stdtr(dof[usable], -deviations)
            found += [(float(x), float(y), name) for x, y in zip(p, deviations, strict=True)]
    return Difference(*min(found), len(found)) if found else None


def print_effort(results: Sequence[Result]) -> None:
    """Prints the replicas of results with a target error, and the errors that they have reached."""
    replicas = [result.replicas for result in results]
    errors = [float(result.provenance["achieved_error"]) for result in results]
    print(
        f"{min(replicas)} to {max(replicas)} replicas (at least 64) gave relative errors of the target quantities of "
        f"{np.nanmin(errors):.2g} to {np.nanmax(errors):.2g}"
    )


def compare(plan: Plan, names: Sequence[str]) -> int:
    """Compares the results of the named panels with those of the quality without an effort. Exit status: 0,
    1 if a difference is less probable than SIGNIFICANCE."""
    quality = Plan(plan.selection.quality)
    alike, found, left_out = 0, [], []
    runs = runs_of([plan[name] for name in names])
    if limited := [load(path) for path, run in runs.items() if "target-error" in run.options]:
        print_effort(limited)
    for path, run in runs.items():
        former = quality[run.panel].run(run.name).path
        if Path(former).is_file():
            try:
                one, other = load(former), load(path)
            except FormatError as error:
                left_out.append(str(error))
                continue
            if equal_values(one, other):
                alike += 1
            elif difference := least_probable(one, other):
                found.append((difference, path))
            else:
                left_out.append(f"{path}: too few replicas to compare")
    if left_out:
        print(f"Not compared: {left_out[0]}" + (f"; {len(left_out) - 1} more" if left_out[1:] else ""))
    if alike:
        print(f"{alike} results are equal to those of {quality.selection.name}")
    if not found:
        return 0
    number = sum(difference.numbers for difference, _ in found)
    least, path = min(found)
    p = min(1.0, number * least.p)  # Bonferroni's correction
    print(
        f"{number} numbers of {len(found)} results against those of {quality.selection.name}: the largest "
        f"difference is {least.deviation:.2g} standard errors ({path}: {least.quantity}), p = {p:.2g}"
    )
    if plan.selection.replicas and plan.selection.seed is None:
        print("The first replicas are shared and not counted as independent: SEED=7 gives independent ones")
    return int(p < SIGNIFICANCE)

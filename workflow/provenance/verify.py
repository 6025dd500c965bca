"""Compares results with those of reruns, of freshly compiled programs (verify) or of FRESH=yes, and with other replicas (SEED, REPLICAS).

Exit status: 0 if all agree, 1 if not; of verify 3 if there is nothing to rerun or a rerun failed.
"""

import argparse
import os
import random
import shutil
import subprocess
from pathlib import Path

import numpy as np
from scipy.special import stdtr

from workflow.files import lock_products
from workflow.lib.load import FormatError, Quantity, Result, load
from workflow.plan import SUFFIXES, Quality, data_path, load_plan, products_of, runs_of, stem_of
from workflow.program import ProgramError, execute

BEFORE, BUILD = Path("build/before"), Path("build/verify")
SIGNIFICANCE = 1e-4  # p-value of the largest difference in a result
COMPUTED = 1e6  # degrees of freedom of a discretisation error


def error_of_difference(a: Quantity, b: Quantity, shared: bool) -> tuple[np.ndarray, np.ndarray]:
    """Standard error of the difference between two estimates, and its degrees of freedom. shared: the fewer replicas are contained in
    the more; for equal replicas, the error of one estimate."""
    if a.count is None or b.count is None:
        return np.asarray(a.discretisation_error), np.full(a.mean.shape, COMPUTED)
    few, many = sorted((a, b), key=lambda quantity: quantity.replicas.max(initial=0))
    if not shared:
        return np.hypot(few.error, many.error), 2.0 * (few.replicas - 1.0)
    # s² (1/m - 1/n) for means of m of n replicas; more where control variates work only with the larger number.
    with np.errstate(divide="ignore", invalid="ignore"):
        variance = many.error**2 * (many.replicas / few.replicas - 1)
    variance = np.maximum(variance, few.error**2 - many.error**2)
    return np.where(many.replicas > few.replicas, np.sqrt(variance), many.error), few.replicas - 1.0


def largest_difference(one: Result, other: Result) -> tuple[float, float, str]:
    """p-value by Student's distribution with Bonferroni's correction, size in standard errors, and quantity of the least probable difference
    between two results of a run. Quantities of different sizes are left out."""
    largest, number = (1.0, 0.0, ""), 0
    shared = one.parameters.get("seed") == other.parameters.get("seed")
    for name, a in one.quantities.items():
        b = other[name]
        if a.mean.shape == b.mean.shape:
            error, freedom = map(np.atleast_1d, error_of_difference(a, b, shared))
            difference = np.atleast_1d(np.abs(a.mean - b.mean))
            usable = (error > 0) & (freedom > 0) & np.isfinite(difference)
            deviations = difference[usable] / error[usable]
            for p, deviation in zip(2 * stdtr(freedom[usable], -deviations), deviations, strict=True):
                largest, number = min(largest, (float(p), float(deviation), name)), number + 1
    return min(1.0, number * largest[0]), *largest[1:]


def compared(former: Path | str, path: Path | str, rerun: bool) -> tuple[float, float, str]:
    """p-value, size in standard errors and description of the difference between two results. Values of a rerun have to be equal. Raises
    FormatError, OSError."""
    if Path(former).read_bytes() == Path(path).read_bytes():
        return 1.0, 0.0, "equal bytes"
    one, other = load(former), load(path)
    if one.provenance["results_digest"] == other.provenance["results_digest"]:
        return 1.0, 0.0, "equal values, by another compiler or other libraries"
    p, deviation, name = largest_difference(one, other)
    if rerun:
        p = 0.0
    elif not name:
        raise FormatError(f"{path} has no errors to compare with, as of one replica")
    return p, deviation, f"largest difference {deviation:.2g} standard errors ({name}), p = {p:.2g}"


def set_aside(options: argparse.Namespace) -> None:
    """Moves the results that FRESH=yes replaces, and removes their figures from the store. After an interruption, results that were made
    again stay."""
    panels = options.panels or options.plan
    paths = [*runs_of(options.plan, panels, options.quality)]
    products = products_of(options.plan, panels, options.quality)
    if any((BEFORE / path).exists() for path in paths) and not all(map(os.path.exists, products)):
        return
    for path in filter(os.path.isfile, paths):
        (BEFORE / path).parent.mkdir(parents=True, exist_ok=True)
        os.replace(path, BEFORE / path)
    for name in panels:
        for suffix in SUFFIXES:
            Path(f"{stem_of(options.plan, name, options.quality)}{suffix}").unlink(missing_ok=True)


def compare(options: argparse.Namespace) -> int:
    """Compares the results of a command with SEED, REPLICAS or FRESH."""
    quality, plan = Quality.of(options.quality), options.plan
    base, found, same = load_plan(quality.base), [], False
    for path, run in runs_of(plan, options.panels or plan, quality.name).items():
        panel = Path(path).parent.name
        own = data_path(quality.base, panel, base[panel].run(run.name))
        former = BEFORE / path if options.fresh else Path(own)
        same |= str(former) == path
        if not former.is_file() or str(former) == path:
            continue
        try:
            found.append((*compared(former, path, options.fresh), path))
        except FormatError as error:
            print(f"Not compared: {f'the former {path} was damaged' if options.fresh else error}")
        if options.fresh:
            former.unlink()
    if not found:
        print(f"{'These are the' if same else 'There are no'} results of {quality.base} to compare with")
        return 0
    differing = [f"  {path}: {text}" for p, _, text, path in found if p <= SIGNIFICANCE]
    farthest = min(found, key=lambda entry: (entry[0], -entry[1]))[2]
    print(
        f"{len(found) - len(differing)} of {len(found)} results agree with the former (p > {SIGNIFICANCE:g}): {farthest}"
    )
    if quality.replicas and quality.seed is None:
        print("The first replicas are shared and not counted as independent: SEED=7 gives independent ones")
    print(*differing, sep="\n", end="\n" * bool(differing))
    return int(bool(differing))


def main(options: argparse.Namespace) -> int:
    """Reruns a sample of the results, or those of a panel, by freshly compiled programs."""
    runs = runs_of(options.plan, options.panels or options.plan, options.quality)
    made = [path for path in runs if Path(path).is_file()]
    if not options.panels:
        made = random.sample(made, min(len(made), max(1, round(float(options.sample) * len(made)))))
    lock_products()
    shutil.rmtree(BUILD, ignore_errors=True)
    settings = os.environ | {"BUILD": str(BUILD)}
    if subprocess.run(["bash", "workflow/environment/build.sh", "all"], env=settings, check=False).returncode:
        return 1
    differing = failed = 0
    for number, path in enumerate(made, 1):
        run, again = runs[path], BUILD / "again.h5"
        try:
            execute(run.program, run.options, again, "--overwrite", programs=BUILD / "bin")
            p, _, text = compared(path, again, rerun=True)
            differing += p == 0
        except (FormatError, ProgramError) as error:
            text, failed = str(error), failed + 1
        print(f"{number} of {len(made)}: {path}: {text}", flush=True)
    print(f"{len(made)} results rerun: {differing} differ, {failed} could not be compared")
    return 1 if differing else 3 if failed or not made else 0

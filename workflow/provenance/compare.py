"""Compares results before and after a rerun from scratch, or with another seed or number of replicas with the quality's own.

Exit status: 1 if a result differs by more than its errors.
"""

import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.special import stdtr

from workflow.lib.command import command
from workflow.lib.files import ROOT, file_hash
from workflow.lib.load import Quantity, load
from workflow.lib.plan import Panel, Quality, data_path, load_plan

BEFORE = Path("build/before")
SIGNIFICANCE = 1e-4  # p-value of the largest deviation in a result
COMPUTED = 1e6  # degrees of freedom assumed for a discretisation error


def keep(quality: str, panels: Sequence[Panel]) -> None:
    """Copies the results that a rerun replaces. An interrupted rerun keeps those from before its first start."""
    for path in (data_path(quality, panel.name, run) for panel in panels for run in panel.runs):
        kept = ROOT / BEFORE / path
        if (ROOT / path).is_file() and not kept.exists():
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / path, kept)


def p_value(one: Path, other: Path) -> float:
    """Bonferroni-corrected p-value, by Student's distribution, of the largest difference between two results; 0 if their
    quantities or shapes differ. Raises FormatError."""
    first, second = load(one).quantities, load(other).quantities
    pairs = [(quantity, second.get(name)) for name, quantity in first.items()]
    if first.keys() != second.keys() or any(b is None or a.mean.shape != b.mean.shape for a, b in pairs):
        return 0.0
    rarest = [tail for a, b in pairs if b is not None for tail in _tails(a, b)]
    return min(1.0, len(rarest) * min(rarest)) if rarest else 1.0


def _tails(a: Quantity, b: Quantity) -> np.ndarray:
    """Two-sided p-value of each difference of values with errors."""
    computed = a.standard_error is None
    error_a, error_b = (np.asarray(q.discretisation_error if computed else q.error) for q in (a, b))
    error, difference = np.atleast_1d(np.hypot(error_a, error_b)), np.atleast_1d(np.abs(a.mean - b.mean))
    replicas = np.full(error.shape, COMPUTED if computed else np.minimum(a.replicas, b.replicas))
    usable = (error > 0) & np.isfinite(difference) & (replicas > 1)
    return np.asarray(2 * stdtr(2 * (replicas[usable] - 1.0), -difference[usable] / error[usable]))


def main() -> None:
    keeping = {"action": "store_true", "help": "keep the present results for the comparison after the rerun"}
    options, _, panels = command(__doc__, keep=keeping)
    if options.keep:
        keep(options.quality, panels)
        return
    quality = Quality.of(options.quality)
    base = load_plan(quality.base)
    again = quality.name == quality.base  # a rerun from scratch
    against = BEFORE / "data" / quality.base if again else Path("data") / quality.base
    values: dict[str, float] = {}
    for panel in panels:
        for run in panel.runs:
            path = data_path(quality.name, panel.name, run)
            reference = data_path(quality.base, panel.name, base[panel.name].run(run.name))
            reference = str(BEFORE / reference) if again else reference
            if (ROOT / reference).is_file():
                same = file_hash(ROOT / path) == file_hash(ROOT / reference)
                values[path] = 1.0 if same else p_value(ROOT / path, ROOT / reference)
    if not values:
        print(f"No results in {against} to compare with: make them first, then repeat this command")
        return
    differing = {path: p for path, p in values.items() if p <= SIGNIFICANCE}
    agree, smallest = len(values) - len(differing), min(values.values())
    print(f"{agree} of {len(values)} results agree with those in {against}, smallest p = {smallest:.2g}")
    for path, p in differing.items():
        print(f"  {path}: p = {p:.2g}")
    shutil.rmtree(ROOT / BEFORE / "data" / quality.base, ignore_errors=True)
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()

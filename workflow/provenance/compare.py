"""Compares results before and after a rerun from scratch, or with another seed or number of replicas with the quality's own.

Exit status: 1 if a result differs by more than its errors.
"""

import argparse
import shutil
from pathlib import Path

import numpy as np
from scipy.special import stdtr

from workflow.identity import ROOT
from workflow.lib.load import Quantity, load
from workflow.plan import Panel, Quality, data_path, load_plan, with_used

BEFORE = Path("build/before")
SIGNIFICANCE = 1e-4  # p-value of the largest deviation in a result
COMPUTED = 1e6  # degrees of freedom assumed for a discretisation error


def keep(options: argparse.Namespace) -> None:
    """Copies the results that a rerun replaces. An interrupted rerun keeps those from before its first start."""
    panels = panels_of(options, load_plan(options.quality))
    for path in (data_path(options.quality, panel.name, run) for panel in panels for run in panel.runs):
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


def main(options: argparse.Namespace) -> int:
    quality = Quality.of(options.quality)
    plan, base = load_plan(quality.name), load_plan(quality.base)
    again = quality.name == quality.base  # a rerun from scratch
    against = BEFORE / "data" / quality.base if again else Path("data") / quality.base
    values: dict[str, float] = {}
    for panel in panels_of(options, plan):
        for run in panel.runs:
            path = data_path(quality.name, panel.name, run)
            reference = data_path(quality.base, panel.name, base[panel.name].run(run.name))
            reference = str(BEFORE / reference) if again else reference
            if (ROOT / reference).is_file():
                same = (ROOT / path).read_bytes() == (ROOT / reference).read_bytes()
                values[path] = 1.0 if same else p_value(ROOT / path, ROOT / reference)
    if not values:
        print(f"No results in {against} to compare with: make them first, then repeat this command")
        return 0
    differing = {path: p for path, p in values.items() if p <= SIGNIFICANCE}
    agree, smallest = len(values) - len(differing), min(values.values())
    print(f"{agree} of {len(values)} results agree with those in {against}, smallest p = {smallest:.2g}")
    for path, p in differing.items():
        print(f"  {path}: p = {p:.2g}")
    shutil.rmtree(ROOT / BEFORE / "data" / quality.base, ignore_errors=True)
    return int(bool(differing))


def panels_of(options: argparse.Namespace, plan: dict[str, Panel]) -> list[Panel]:
    """The requested panels after those whose results they plot."""
    names = options.panels or plan
    return [*{panel.name: panel for name in names for panel in with_used(plan, name)}.values()]

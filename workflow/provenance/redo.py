"""Makes a product again in another folder, as its record in the lock says."""

import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.special import stdtr  # scipy.stats takes half a second to import

from workflow.lib.load import Quantity, load
from workflow.lib.parents import PACKAGES
from workflow.provenance.execute import ENVIRONMENT, UNCONVERGED, program_command, script_command
from workflow.provenance.lock import Job
from workflow.provenance.repository import ROOT, machine

ROUNDING = 1e-9  # relative: what another processor's vector units may change in a table
MANY = 1000  # replicas


class RedoError(RuntimeError):
    """The program or script failed."""


def simulate(job: Job, folder: Path) -> Path:
    """Runs the program; returns the file that it wrote."""
    output = folder / "again.h5"
    _run([*program_command(job.tool, job.options, output), "--progress", "none"], (0, UNCONVERGED))
    return output


def draw(job: Job, folder: Path) -> dict[str, Path]:
    """Draws the panel into the folder; returns the new file for each recorded one."""
    stem = (folder / min(job.outputs)).with_suffix("")
    sources = [path for path in job.sources if path != PACKAGES]
    _run(script_command(job.tool, job.options["configuration"], sources, job.data, stem))
    return {path: folder / path for path in job.outputs}


def redrawn(job: Job, folder: Path) -> dict[str, bool]:
    """Draws the panel again: the files that get other bytes, each with whether rounding explains it, as it can on
    another kind of machine: that of any picture, and of a table whose numbers agree. Raises RedoError."""
    elsewhere = job.machine != machine()
    return {
        path: elsewhere and (not path.endswith(".csv") or tables_agree(ROOT / path, new))
        for path, new in draw(job, folder).items()
        if not same_bytes(ROOT / path, new)
    }


def _run(command: list[str], allowed: tuple[int, ...] = (0,)) -> None:
    done = subprocess.run(command, cwd=ROOT, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise RedoError(f"{Path(command[0]).name} ended with status {done.returncode}: {last}")


def tables_agree(one: Path, other: Path) -> bool:
    """Whether two tables are equal but for rounding."""
    first, second = (pd.read_csv(path, comment="#") for path in (one, other))
    try:
        pd.testing.assert_frame_equal(first, second, rtol=ROUNDING, atol=0)
    except AssertionError:
        return False
    return True


def disagreement(one: Path, other: Path) -> tuple[float, float]:
    """Of two results of one run: the largest difference in standard errors, and the probability of one as
    large among so many values, from Student's distribution. (inf, 0) if they are not comparable."""
    first, second = load(one).quantities, load(other).quantities
    if first.keys() != second.keys():
        return np.inf, 0
    pairs = [_deviations(first[name], second[name]) for name in first]
    deviations, freedom = (np.concatenate(part) for part in zip(*pairs, strict=True))
    if deviations.size == 0:
        return 0, 1
    rarest = float(np.min(2 * stdtr(freedom, -deviations)))
    return float(deviations.max()), min(1, deviations.size * rarest)


def _deviations(a: Quantity, b: Quantity) -> tuple[np.ndarray, np.ndarray]:
    """Differences in standard errors, and their degrees of freedom; a discretisation error counts as the
    standard error of many replicas."""
    if a.mean.shape != b.mean.shape:
        return np.array([np.inf]), np.array([1.0])
    computed = a.standard_error is None
    errors = [q.discretisation_error if computed else q.standard_error for q in (a, b)]
    error = np.atleast_1d(np.hypot(*errors))
    difference = np.atleast_1d(np.abs(a.mean - b.mean))
    replicas = np.full(error.shape, MANY) if computed else np.atleast_1d(np.minimum(a.count, b.count))
    known = (error > 0) & np.isfinite(difference) & (replicas > 1)
    return difference[known] / error[known], 2 * (replicas[known] - 1.0)


def same_bytes(one: Path, other: Path) -> bool:
    return one.read_bytes() == other.read_bytes()

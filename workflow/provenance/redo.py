"""Makes a product again in another folder, as its record in the lock says."""

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from scipy.special import stdtr  # scipy.stats takes half a second to import

from workflow.lib.load import Quantity, load
from workflow.lib.options import arguments
from workflow.lib.parents import PACKAGES, file_hash
from workflow.provenance.execute import ENVIRONMENT, LAUNCH, UNCONVERGED, script_command
from workflow.provenance.job import Job
from workflow.provenance.likeness import alike
from workflow.provenance.repository import ROOT, machine

MANY = 1000  # replicas
SAME_PLACE = 1e-9  # relative
SIGNIFICANCE = 1e-3  # of the largest of many deviations of independent random numbers
WELL_KNOWN, UNLIKE = 8, 30  # from so many replicas on, errors of one magnitude do not differ by such a factor
SCHEMA = "workflow/config/schema.yaml"  # the units of options, which the scripts read


class RedoError(RuntimeError):
    """The program or script failed, or what it is to be made from is not there."""


@contextmanager
def workplace() -> Iterator[Path]:
    """A folder for a series of drawings, with a matplotlib of its own: no setting, font list or byte-compiled file
    that lies in the project is read."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "matplotlib").mkdir()
        yield Path(folder)


def simulate(job: Job, programs: Path, folder: Path) -> Path:
    """Runs the program of that folder; returns the file that it wrote. Raises RedoError."""
    output = folder / "again.h5"
    command = [
        str(programs / job.tool),
        *arguments(job.options),
        "--output",
        str(output),
        "--progress",
        "none",
    ]
    _run(command, folder, ENVIRONMENT, (0, UNCONVERGED))
    return output


def draw(job: Job, folder: Path) -> dict[str, Path]:
    """Draws the panel into the folder, from copies of the sources and data that the lock names, and of what starts a
    script; returns the new file for each recorded one. Raises RedoError."""
    sources = [path for path in job.sources if path != PACKAGES]
    if job.tool not in sources or Path(job.tool).parent != Path("workflow/figures"):
        raise RedoError(f"{job.tool} is no script of a figure")
    for path, digest in job.inputs.items():
        _copy(path, folder)
        if file_hash(folder / path) != digest:
            raise RedoError(f"{path} is not what it was drawn from")
    for path in (LAUNCH, SCHEMA):
        _copy(path, folder)
    stem = Path(min(job.outputs)).with_suffix("")
    command = script_command(job.tool, job.options["configuration"], sources, job.data, stem)
    settings = ENVIRONMENT | {"MPLCONFIGDIR": str(folder.parent / "matplotlib")}
    _run(command, folder, settings)
    return {path: folder / path for path in job.outputs}


def _copy(path: str, folder: Path) -> None:
    target = folder / path
    if not target.resolve().is_relative_to(folder.resolve()):
        raise RedoError(f"{path} is no path below the project")
    if not (ROOT / path).is_file():
        raise RedoError(f"{path} is missing")
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / path, target)


def redrawn(job: Job, folder: Path) -> dict[str, bool]:
    """Draws the panel again: the files that get other bytes, each with whether rounding explains it, as it can on
    another kind of machine. Raises RedoError."""
    elsewhere = job.machine != machine()
    return {
        path: elsewhere and alike(ROOT / path, new)
        for path, new in draw(job, folder).items()
        if not same_bytes(ROOT / path, new)
    }


def _run(command: list[str], folder: Path, settings: dict[str, str], allowed: tuple[int, ...] = (0,)) -> None:
    done = subprocess.run(command, cwd=folder, env=settings, capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise RedoError(f"{Path(command[0]).name} ended with status {done.returncode}: {last}")


def agreement(one: Path, other: Path) -> tuple[bool, str]:
    """Whether two results of one run agree within errors, and in words. Raises FormatError."""
    largest, probability = disagreement(one, other)
    within = probability > SIGNIFICANCE
    words = "within errors" if within else "not within errors"
    return within, f"{words}: largest |z| {largest:.2g}, p = {probability:.2g}"


def disagreement(one: Path, other: Path) -> tuple[float, float]:
    """Of two results of one run: the largest difference in standard errors, and the probability of one as
    large among so many values, from Student's distribution. (inf, 0) if they are not comparable."""
    first, second = load(one).quantities, load(other).quantities
    if first.keys() != second.keys() or not all(_comparable(first[name], second[name]) for name in first):
        return np.inf, 0
    pairs = [_deviations(first[name], second[name]) for name in first]
    deviations, freedom = (np.concatenate(part) for part in zip(*pairs, strict=True))
    if deviations.size == 0:
        return 0, 1
    rarest = float(np.min(2 * stdtr(freedom, -deviations)))
    return float(deviations.max()), min(1, deviations.size * rarest)


def _comparable(a: Quantity, b: Quantity) -> bool:
    """Whether both are the same quantity at the same places, known at the same ones, with errors of one magnitude."""
    if a.mean.shape != b.mean.shape or (a.units, a.axis_units) != (b.units, b.axis_units):
        return False
    if (a.standard_error is None) != (b.standard_error is None):
        return False
    if not all(np.allclose(a.axes[name], b.axes[name], rtol=SAME_PLACE, atol=0) for name in a.axes):
        return False
    if a.standard_error is None:
        return np.array_equal(np.isnan(a.mean), np.isnan(b.mean))
    enough = np.minimum(a.replicas, b.replicas) >= WELL_KNOWN
    known = [np.isfinite(q.mean) & (q.error > 0) for q in (a, b)]
    scales = [q.error * np.sqrt(q.replicas) for q in (a, b)]
    with np.errstate(divide="ignore", invalid="ignore"):
        far = np.abs(np.log(scales[0] / scales[1])) > np.log(UNLIKE)
    lost, either, both = enough & (known[0] != known[1]), known[0] | known[1], known[0] & known[1]
    # Rare values may be known in one run only, but not most of them.
    return bool(2 * np.sum(lost) <= np.sum(either)) and not np.any(enough & both & far)


def _deviations(a: Quantity, b: Quantity) -> tuple[np.ndarray, np.ndarray]:
    """Differences in standard errors, and their degrees of freedom; a discretisation error counts as the
    standard error of many replicas."""
    computed = a.standard_error is None
    one, other = (q.error if q.discretisation_error is None else q.discretisation_error for q in (a, b))
    error = np.atleast_1d(np.hypot(one, other))
    difference = np.atleast_1d(np.abs(a.mean - b.mean))
    replicas = np.full(error.shape, MANY) if computed else np.atleast_1d(np.minimum(a.replicas, b.replicas))
    known = (error > 0) & np.isfinite(difference) & (replicas > 1)
    return difference[known] / error[known], 2 * (replicas[known] - 1.0)


def same_bytes(one: Path, other: Path) -> bool:
    return file_hash(one) == file_hash(other)

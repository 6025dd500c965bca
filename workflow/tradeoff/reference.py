"""Runs the reference simulators of tests/cpp/reference for what they find and what they cost."""

import resource
import subprocess
from pathlib import Path

import numpy as np

from workflow.lib.configuration import Options

# What a line of reference_open_chain begins with, and the number of values per cell and besides.
COLUMNS = {
    "temperature_scatterer": (1, 0),
    "temperature_particle": (1, 0),
    "density": (1, 0),
    "rate_right": (1, 0),
    "rate_left": (1, 0),
    "particle_current": (1, 1),
    "energy_current": (1, 1),
}
NO_BINS = (2, 1)  # the least of a histogram that is not looked at: bins, largest momentum


def _rows(words: list[object]) -> tuple[np.ndarray, float]:
    """Numbers that a simulator prints, a row per replica, and CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    output = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return np.array([[float(word) for word in line.split()] for line in output.splitlines()]), seconds


def open_chain(
    programs: Path, options: Options, cells: int, times: tuple[str, str], replicas: int
) -> tuple[dict[str, np.ndarray], float]:
    """[replica, cell or bond] of every quantity, from an empty start; times: relaxation and observation."""
    visited = cells if options["gamma"] == "N" else options["gamma"]
    ends = [options[f"{name}-{end}"] for name in ("nu", "temperature") for end in ("left", "right")]
    words = [programs / "reference_open_chain", cells, 1 / cells, options["sigma"], visited, *ends, *times]
    rows, seconds = _rows([*words, *NO_BINS, replicas, 1])
    sizes = [per_cell * cells + more for per_cell, more in COLUMNS.values()]
    parts = np.split(rows, np.cumsum(sizes), axis=1)
    return dict(zip(COLUMNS, parts, strict=False)), seconds


def pulse(programs: Path, options: Options, replicas: int, start: str) -> tuple[np.ndarray, float]:
    """[replica, time, cell] of the energy with the pulse minus without; start: shared or independent."""
    visited = options["cells"] if options["gamma"] == "N" else options["gamma"]
    times = options["times"].split(",")
    words = [programs / "reference_pulse", options["cells"], options["particles-per-cell"], options["sigma"]]
    words += [
        visited,
        options["energy"],
        options["pulse-energy"],
        options["pairs-per-replica"],
        replicas,
        1,
        start,
    ]
    rows, seconds = _rows([*words, *times])
    return rows.reshape(replicas, len(times), options["cells"]), seconds

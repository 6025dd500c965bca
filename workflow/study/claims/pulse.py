"""Claims on the energy pulse (figs. 9 and 10).

Statements as printed are judged from the paper's start, scatterers at rest that have relaxed; other starts
and rings belong to what is meant.
"""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np

from workflow.lib.load import Result
from workflow.physics.pulse import resolved
from workflow.study.results import MissingError, Results, estimate, exponent_between
from workflow.study.verdict import Estimate

PAPERS_START = "rest"  # runs of figs. 9a and 9b
PEAK_BIAS = 0.013  # largest relative bias of the fitted height (cpp/observables/energy_pulse/moving_peak.hpp)
RESOLVED = (0.032, 0.04)  # first times at which the front spans the cells that the fit of its height needs
LEFT, ODD, SPEED = 0.1, 0.1, 0.25  # bounds of the numbers of peaks_leave


def peaks_leave(data: Results) -> list[Estimate]:
    """The fraction of the energy in the five central cells at the last time, the odd part at the peak over
    the peak at every time, and d ln v/d ln t of the peaks between the first and the last pair of times,
    each over its bound."""
    result = data.one("fig09a", PAPERS_START)
    share = estimate(result, "centre_share", -1, "fraction in the centre/0.1")
    return [share / LEFT, *(part / ODD for part in _odd_parts(result)), _slowing(result)]


def _odd_parts(result: Result) -> list[Estimate]:
    height, position, odd = result["peak"].mean, result["peak_position"].mean, result["odd_part"]
    distance, times = odd.axes["distance"], odd.axes["time"]
    numbers = []
    for k in resolved(position):
        nearest = int(np.abs(distance - position[k]).argmin())
        label = f"odd part of the peak/0.1, t = {times[k]:g}"
        numbers.append(estimate(result, "odd_part", (k, nearest), label) / height[k])
    return numbers


def _slowing(result: Result) -> Estimate:
    """d ln v/d ln t of the peaks between the first and the last pair of times, over its bound."""
    speed = result["peak_speed"]
    moving = np.flatnonzero(speed.mean > 0)
    if len(moving) < 2:
        raise MissingError("too few times with a moving peak")
    first, last = (estimate(result, "peak_speed", k) for k in moving[[0, -1]])
    time = speed.axes["middle"][moving]
    return exponent_between(first, last, time[-1] / time[0], "(d ln v/d ln t)/(1/4)") / SPEED


def ballistic(data: Results) -> list[Estimate]:
    """Exponent of the peak's position at gamma = 1, from the paper's start."""
    result = data.one("fig09b", PAPERS_START)
    known = _times(result)
    return [_way(result, known[0], known[-1], "d ln x_p/d ln t")]


def _times(result: Result) -> list[int]:
    """Indices of the times with a moving peak. Raises MissingError if there are fewer than two."""
    known = [*map(int, resolved(result["peak_position"].mean))]
    if len(known) < 2:
        raise MissingError("too few times with a moving peak")
    return known


def _way(result: Result, a: int, b: int, label: str) -> Estimate:
    """Exponent of the peak's position between two times."""
    times = result["peak_position"].axes["time"]
    first, last = (estimate(result, "peak_position", k) for k in (a, b))
    return exponent_between(first, last, float(times[b] / times[a]), label)


def ballistic_later(data: Results) -> list[Estimate]:
    """Exponents of the position in a ring ten times as long at later times, between neighbouring times."""
    ring = data.one("fig10b", "long")
    times = ring["peak_position"].axes["time"]
    return [
        _way(ring, a, b, f"d ln x_p/d ln t, t = {times[a]:g} to {times[b]:g}")
        for a, b in pairwise(_times(ring))
    ]


def damping(data: Results) -> list[Estimate]:
    """Damping exponents of the paper's pulse at gamma = N, by octave from RESOLVED on. The bias of the fits
    of the peak's height bounds the systematic error."""
    result = data.one("fig09a", PAPERS_START)
    octaves = [
        replace(one, systematic=PEAK_BIAS / math.log(until / start))
        for start, until, one in _by_octave(result)
        if start >= RESOLVED[0]
    ]
    if not octaves:
        raise MissingError(f"no octave from t = {RESOLVED[0]} on")
    return octaves


def damping_fits(data: Results) -> list[Estimate]:
    """Damping exponents of the paper's pulse at gamma = N, fitted from RESOLVED on."""
    result = data.one("fig09a", PAPERS_START)
    begins = result["damping_exponent_from"].axes["from"]
    fits = np.flatnonzero(np.isclose(begins[:, None], RESOLVED).any(axis=1))
    if len(fits) < len(RESOLVED):
        raise MissingError(f"no fits from t = {RESOLVED} on")
    return [estimate(result, "damping_exponent_from", k, f"fit from t = {begins[k]:g} on") for k in fits]


def damping_rare(data: Results) -> list[Estimate]:
    """Damping exponents at gamma = 1 from the paper's start, by octave. In free flight of Gaussian momenta
    [eq. 44] the cell of the pulse and that of the measurement lower a peak x cells away by 1/(3 x²), in an
    aged chain by 1/(6 x²). The change of the exponent by 1/(3 x²) bounds the systematic error."""
    result = data.one("fig09b", PAPERS_START)
    position = result["peak_position"]
    cells = dict(zip(position.axes["time"], position.mean, strict=True))
    return [
        replace(one, systematic=(cells[start] ** -2 - cells[until] ** -2) / 3 / math.log(until / start))
        for start, until, one in _by_octave(result)
    ]


def _by_octave(result: Result) -> list[tuple[float, float, Estimate]]:
    """First time, last time and damping exponent of the octaves of a pulse, each of which begins where the
    one before it ends. NaN, so unknown, if the peak is not resolved in most of the octave."""
    times = [result["peak"].axes["time"][0], *result["local_damping_exponent"].axes["until"]]
    octaves = []
    for k, (start, until) in enumerate(pairwise(map(float, times))):
        label = f"damping exponent, t = {start:g} to {until:g}"
        octaves.append((start, until, estimate(result, "local_damping_exponent", k, label)))
    return octaves

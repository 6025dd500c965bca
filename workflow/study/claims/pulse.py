"""Claims on the energy pulse (figs. 9 and 10), and on its relation to the conductivity.

Literal statements are judged from the paper's start, scatterers at rest that have relaxed. Other starts,
rings and pulses belong to the intended meaning.
"""

from dataclasses import replace

import numpy as np

from workflow.lib.load import Result
from workflow.physics.pulse import resolved
from workflow.study.claims.growth import of_largest
from workflow.study.results import MissingError, Results, combination, estimate, log_slope
from workflow.study.verdict import Estimate, with_systematic

PAPERS_START = "rest"  # runs of figs. 9a and 9b
PEAK_BIAS = 0.02  # largest bias of the damping exponent of an octave (cpp/statistics/moving_peak.hpp)
LEFT, ODD, SPEED = 0.1, 0.1, 0.25  # bounds of the numbers of peaks_leave


def peaks_leave(data: Results) -> list[Estimate]:
    """The fraction of the energy in the five central cells at the last time, the odd part at the peak over
    the peak at every time, and d ln v/d ln t of the peaks between the first and the last pair of times,
    each over its bound."""
    result = data.one("fig09a", PAPERS_START)
    share = estimate(result, "centre_share", -1, "fraction in the centre/0.1")
    slowing = replace(_slowing(result), label="(d ln v/d ln t)/(1/4)")
    odd = [part / ODD for part in _odd_parts(result)]
    return [share / LEFT, *odd, slowing / SPEED]


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
    speed = result["peak_speed"]
    moving = np.flatnonzero(speed.mean > 0)
    if len(moving) < 2:
        raise MissingError("too few times with a moving peak")
    first, last = (estimate(result, "peak_speed", k) for k in moving[[0, -1]])
    time = speed.axes["middle"][moving]
    return log_slope(first, last, time[-1] / time[0])


def ballistic(data: Results) -> list[Estimate]:
    """Exponent of the peak's position at gamma = 1 from the paper's start."""
    return [_way(data.one("fig09b", PAPERS_START))]


def ballistic_later(data: Results) -> list[Estimate]:
    """The same in a ring ten times as long at later times, where the width of the cell in which the pulse
    begins no longer counts."""
    ring = data.one("fig10b", "long")
    return [_way(ring)]


def _way(result: Result) -> Estimate:
    """Exponent of the position between the first and the last time with a moving peak. The exponents
    without the first or without the last of them bound the systematic error."""
    known = resolved(result["peak_position"].mean)
    if len(known) < 3:
        raise MissingError("too few times with a moving peak")
    times = result["peak_position"].axes["time"]

    def between(first: int, last: int) -> Estimate:
        early, late = (estimate(result, "peak_position", k) for k in (first, last))
        return log_slope(early, late, times[last] / times[first])

    slope, *others = (between(*known[list(ends)]) for ends in ((0, -1), (1, -1), (0, -2)))
    label = f"d ln x_p/d ln t, N = {result.parameters['cells']}"
    return with_systematic(replace(slope, label=label), [other.value for other in others])


def damping(data: Results) -> list[Estimate]:
    """Damping exponent of the paper's pulse at gamma = N, fitted to all times. Fits that begin later and
    the bias of the fits of the peak's height bound the systematic error."""
    fit = _of_all_times(data.one("fig09a", PAPERS_START), "damping exponent")
    return [replace(fit, systematic=fit.systematic + PEAK_BIAS)]


def damping_rare(data: Results) -> list[Estimate]:
    """Damping exponent at gamma = 1 from the paper's start."""
    return [_of_all_times(data.one("fig09b", PAPERS_START), "damping exponent")]


def _of_all_times(result: Result, label: str) -> Estimate:
    """Damping exponent over all times. Fits that leave out up to half of the times bound the systematic
    error."""
    later = [float(slope) for slope in result["damping_exponent_from"].mean]
    slope = estimate(result, "damping_exponent", label=label)
    return with_systematic(slope, later[1 : len(later) // 2 + 1])


def relation_of_moving_peaks(data: Results) -> list[Estimate]:
    """2 - 1/xi minus the exponent of kappa over the largest sizes, with xi of the pulse's moving peaks,
    for both gamma."""
    excesses = []
    for panel, gamma in (("fig09a", "N"), ("fig09b", 1)):
        xi = _of_all_times(data.one(panel, PAPERS_START), "")
        slope = xi.value**-2
        expected = Estimate("", 2 - 1 / xi.value, slope * xi.error, xi.dof, slope * xi.systematic)
        label = f"2 - 1/ξ minus exponent of κ, γ = {gamma}"
        excesses.append(combination([expected, of_largest(data, gamma)], [1, -1], label))
    return excesses

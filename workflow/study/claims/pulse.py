"""Claims on the energy pulse (figs. 9 and 10), and on its relation to the conductivity.

Literal statements are judged from the paper's start, scatterers at rest that have relaxed. Other starts,
rings and pulses belong to the intended meaning.
"""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np

from workflow.lib.load import Result
from workflow.physics.pulse import resolved
from workflow.study.claims.growth import FIRST, conductivities
from workflow.study.results import MissingError, Results, combination, estimate, exponent_between, power
from workflow.study.verdict import Estimate

PAPERS_START = "rest"  # runs of figs. 9a and 9b
PEAK_BIAS = 0.02  # largest bias of the damping exponent of an octave (cpp/statistics/moving_peak.hpp)
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
    """Exponent of the peak's position at gamma = 1 from the paper's start, minus that of free flight out of the
    profile at the first time, attenuated by the scattering."""
    result = data.one("fig09b", PAPERS_START)
    known = _times(result)
    way = _way(result, known[0], known[-1], "d ln x_p/d ln t minus that of attenuated free flight")
    times = result["peak_position"].axes["time"]
    factor = float(times[known[-1]] / times[known[0]])
    ratio_of_free = free_flight(result, known[0], factor) / free_flight(result, known[0], 1)
    return [way - math.log(ratio_of_free) / math.log(factor)]


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


def free_flight(result: Result, k: int, factor: float) -> float:
    """Position of the peak, in cells, `factor` times later than at time k: the maximum of E(y) exp(-y (factor - 1)
    gamma/N) at y = x/factor, with the energy E(y) at time k and mean free path N/gamma. E is the program's fit,
    exp(a s² + b s³) at s from its peak. Raises MissingError if it has no such maximum."""
    position, a, b = (
        float(result[name].mean[k]) for name in ("peak_position", "peak_quadratic", "peak_cubic")
    )
    lost = (factor - 1) * float(result.parameters["gamma"]) / int(result.parameters["cells"])
    discriminant = a**2 + 3 * b * lost
    if not discriminant > 0:
        raise MissingError("the fit of the peak has no maximum after the attenuation")
    return factor * (position + lost / (a - math.sqrt(discriminant)))


def ballistic_later(data: Results) -> list[Estimate]:
    """Exponents of the position in a ring ten times as long at later times, between neighbouring times."""
    ring = data.one("fig10b", "long")
    times = ring["peak_position"].axes["time"]
    return [
        _way(ring, a, b, f"d ln x_p/d ln t, t = {times[a]:g} to {times[b]:g}")
        for a, b in pairwise(_times(ring))
    ]


def damping(data: Results) -> list[Estimate]:
    """Damping exponents of the paper's pulse at gamma = N, by octave. The bias of the fits of the peak's height
    bounds the systematic error."""
    octaves = _by_octave(data.one("fig09a", PAPERS_START))
    return [replace(octave, systematic=PEAK_BIAS) for octave in octaves]


def damping_fits(data: Results) -> list[Estimate]:
    """Damping exponents of the paper's pulse at gamma = N, fitted from RESOLVED on."""
    result = data.one("fig09a", PAPERS_START)
    begins = result["damping_exponent_from"].axes["from"]
    fits = np.flatnonzero(np.isclose(begins[:, None], RESOLVED).any(axis=1))
    if len(fits) < len(RESOLVED):
        raise MissingError(f"no fits from t = {RESOLVED} on")
    return [estimate(result, "damping_exponent_from", k, f"fit from t = {begins[k]:g} on") for k in fits]


def damping_rare(data: Results) -> list[Estimate]:
    """Damping exponents at gamma = 1 from the paper's start, by octave."""
    return _by_octave(data.one("fig09b", PAPERS_START))


def _by_octave(result: Result) -> list[Estimate]:
    """Damping exponents of a pulse. NaN, so unknown, if the peak is not resolved in most of the octave."""
    until = result["local_damping_exponent"].axes["until"]
    return [
        estimate(result, "local_damping_exponent", k, f"damping exponent, until t = {time:g}")
        for k, time in enumerate(until)
    ]


def relation_of_moving_peaks(data: Results) -> list[Estimate]:
    """2 - 1/xi, with xi of the pulse's moving peaks, minus the exponent of kappa, at gamma = 1."""
    xi = estimate(data.one("fig09b", PAPERS_START), "damping_exponent")
    expected = Estimate("", 2 - 1 / xi.value, xi.error / xi.value**2, xi.dof)
    kappa = {size: value for size, value in conductivities(data, 1).items() if size >= FIRST}
    exponent = power(kappa, "d ln κ/d ln N, γ = 1")
    return [combination([expected, exponent], [1, -1], f"2 - 1/ξ minus {exponent.label}")]

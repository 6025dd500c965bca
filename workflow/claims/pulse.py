"""Claims on the energy pulse (figs. 9 and 10), and on what links it to the conductivity."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from workflow.claims.data import Claim, Data, Evidence, MissingError, combination, number, where_made
from workflow.claims.growth import equilibrium, exponent, largest_sizes, sizes
from workflow.claims.verdict import Number, with_systematic
from workflow.figures.fig09 import gaussian_start, ring_closed, start
from workflow.lib import style
from workflow.lib.caption import goodness
from workflow.lib.fit import rejected, with_error
from workflow.lib.load import Quantity, Result

APART = 2  # standard errors
PEAK_BIAS = 0.02  # of an octave's damping exponent, at most (cpp/statistics/moving_peak.hpp)


def _pulse(data: Data, panel: str) -> Result:
    return gaussian_start(data.of(panel))


def _from_rest(data: Data, panel: str) -> Result:
    """The paper's start, in which scatterers at rest have relaxed. It has fewer pairs, and bounds the systematic error."""
    return next(result for result in data.of(panel) if start(result) != "particles")


def _bounded(found: Number, others: Sequence[float], rest: Number) -> Number:
    """With the systematic error by other fits, and by the other start if it differs by more than chance explains."""
    return with_systematic(found, [*others, *([rest.value] if _apart(found, rest) else [])])


def _apart(found: Number, rest: Number) -> bool:
    return abs(rest.value - found.value) > APART * math.hypot(rest.error, found.error)


def _of_rest(found: Number, rest: Number) -> str:
    """What the start at rest gives, in words."""
    covered = (
        "which the systematic bound covers" if _apart(found, rest) else "no farther off than chance explains"
    )
    return f"From the start at rest, the paper's, it is {with_error(rest.value, rest.error)}, {covered}."


def peaks_leave(data: Data) -> Evidence:
    """Share of the energy in the five central cells at the end; odd part at the peak over the peak, at every time."""
    result = _pulse(data, "fig09a")
    share = number(result, "centre_share", -1, "share of the five central cells at the last time")
    return Evidence([share, *_odd_parts(result)], caveat=_speeds(result))


def _odd_parts(result: Result) -> list[Number]:
    height, place, odd = result["peak"].mean, result["peak_position"].mean, result["odd_part"]
    distance, times = odd.axes["distance"], odd.axes["time"]
    found = []
    for k in np.flatnonzero(np.isfinite(place)):
        nearest = int(np.abs(distance - place[k]).argmin())
        label = f"odd part over the peak, t = {times[k]:g}"
        found.append(number(result, "odd_part", (k, nearest), label).over(height[k]))
    return found


def _speeds(result: Result, where: str = "") -> str:
    speed = result["peak_speed"]
    known = np.flatnonzero(np.isfinite(speed.mean))
    if not len(known):
        return f"No moving peak was found{where}."
    told = [f"{style.with_error(speed, k)} at t = {speed.axes['middle'][k]:.3g}" for k in known[[0, -1]]]
    return f"Speed of the peaks{where}: {', '.join(told)}."


def ballistic(data: Data) -> Evidence:
    """Exponent of the peak's position: literal, from the paper's start; intended, in a ring ten times as long at later times, where the
    width of the cell in which the pulse begins no longer counts."""
    rest, long = _from_rest(data, "fig09b"), data.one("ext14", "long")
    return Evidence(
        [_way(rest, "paper's start")],
        [_way(long, f"N = {long.parameters['cells']}")],
        caveat=f"{_speeds(rest)} {_speeds(long, ' in the long ring')}",
    )


def _way(result: Result, name: str) -> Number:
    """Exponent of the position between the first and the last time with a moving peak. What it is without the first or the last of
    them bounds the systematic error."""
    known = np.flatnonzero(np.isfinite(result["peak_position"].mean))
    if len(known) < 3:
        raise MissingError("too few times with a moving peak")
    times = result["peak_position"].axes["time"][known[[0, -1]]]
    label = f"d ln x_p/d ln t, {name}, t = {times[0]:g} to {times[1]:g}"
    found, *others = (_between(result, *known[list(ends)]) for ends in ((0, -1), (1, -1), (0, -2)))
    return with_systematic(replace(found, label=label), [one.value for one in others])


def _between(result: Result, first: int, last: int) -> Number:
    time = result["peak_position"].axes["time"]
    one, two = (number(result, "peak_position", k) for k in (first, last))
    return _log_slope("", one, two, time[last] / time[first])


def _log_slope(label: str, first: Number, last: Number, factor: float) -> Number:
    """Slope on logarithmic axes between two times, the later of which is `factor` times the first."""
    span = math.log(factor)
    error = math.hypot(first.error / first.value, last.error / last.value) / span
    return Number(label, math.log(last.value / first.value) / span, error, first.freedom)


def speed_falls(data: Data) -> Evidence:
    """d ln v/d ln t of the peaks between the first and the last pair of times: from the paper's start, and with a tenth of the energy."""
    rest, weak = _from_rest(data, "fig09a"), data.one("ext14", "weak")
    return Evidence(
        [_slowing(rest, "the paper's pulse")],
        alternative=[_slowing(weak, "a tenth of its energy")],
        caveat=f"{_speeds(rest)} {_speeds(weak, ' with a tenth of the energy')}",
    )


def _slowing(result: Result, name: str) -> Number:
    speed = result["peak_speed"]
    known = np.flatnonzero(speed.mean > 0)
    if len(known) < 2:
        raise MissingError("too few times with a moving peak")
    first, last = (number(result, "peak_speed", k) for k in known[[0, -1]])
    time = speed.axes["middle"][known]
    return _log_slope(f"d ln v/d ln t, {name}", first, last, time[-1] / time[0])


def damping(data: Data) -> Evidence:
    """Literal: of every octave of the paper's pulse, which a power law has in common. Intended: of a pulse with a tenth of its energy,
    which is no shock. Alternative: of sound in equilibrium."""
    rest, weak = _from_rest(data, "fig09a"), data.one("ext14", "weak")
    return Evidence(
        _octaves(rest),
        [_of_all_times(weak, "damping exponent, a tenth of the energy")],
        where_made(lambda: [_sound(data)]),
        caveat=f"Over all times it is {style.with_error(rest['damping_exponent'])} from the paper's start, and changes by {style.with_error(rest['damping_drift'])} "
        f"per unit of ln t. The pulse is a shock. {_speeds(rest)} With a tenth of the energy the exponent changes by "
        f"{style.with_error(weak['damping_drift'])} per unit of ln t.",
    )


def _octaves(result: Result) -> list[Number]:
    """Damping exponents by octave of time; the fits of the peak's height bound their systematic errors."""
    local = result["local_damping_exponent"]
    found = [
        number(
            result, "local_damping_exponent", k, f"damping exponent, paper's start, octave to t = {until:g}"
        )
        for k, until in enumerate(local.axes["until"])
        if np.isfinite(local.mean[k])
    ]
    return [with_systematic(one, [one.value + PEAK_BIAS]) for one in found]


def _of_all_times(result: Result, label: str) -> Number:
    """Fits that leave out up to half of the times bound the systematic error."""
    found = number(result, "damping_exponent", label=label)
    return with_systematic(found, _later(result["damping_exponent_from"]))


def _sound(data: Data) -> Number:
    """Damping exponent of the sound peak in equilibrium, of the longest record."""
    rings = data.of("ext03", "correlation")
    longest = max(rings, key=lambda one: float(one["peak"].axes["time"][-1]))
    return _of_all_times(longest, f"sound peak in equilibrium, N = {longest.parameters['cells']}")


def _later(fitted: Quantity) -> list[float]:
    """Exponents of the fits that leave out up to half of the times."""
    return [float(one) for one in fitted.mean[1 : len(fitted.mean) // 2 + 1]]


def _drift(result: Result) -> tuple[bool, str]:
    """Whether the exponent changes with ln t by more than chance, and what to say of it."""
    if ring_closed(result).any():
        return False, "may change unseen, as the ring has closed"
    change = result["damping_drift"]
    value, error = float(change.mean), float(change.error)
    if not np.isfinite(value):
        return False, "may change unseen, over too few octaves"
    chi_square = (value / error) ** 2
    told = f"changes by {with_error(value, error)} per unit of ln t, {goodness(chi_square, 1)}"
    return rejected(chi_square, 1), told


def damping_exponent(data: Data, panel: str) -> Number:
    """Fits that leave out up to half of the times, and the other start, bound the systematic error."""
    result = _pulse(data, panel)
    drifts, _ = _drift(result)
    label = "damping exponent, Gaussian start" + (", a mean slope" if drifts else "")
    found = number(result, "damping_exponent", label=label)
    rest = number(_from_rest(data, panel), "damping_exponent")
    return _bounded(found, _later(result["damping_exponent_from"]), rest)


def _other_fits(data: Data, panel: str) -> str:
    result = _pulse(data, panel)
    fitted = result["damping_exponent_from"]
    half = len(fitted.mean) // 2
    drifts, change = _drift(result)
    found, rest = (number(one, "damping_exponent") for one in (result, _from_rest(data, panel)))
    return (
        f"{'No power of t describes' if drifts else 'A power of t describes'} the height: its exponent {change}. Fitted from "
        f"t = {fitted.axes['from'][half]:g} on it is {style.with_error(fitted, half)}. {_of_rest(found, rest)}"
    )


def damping_rare(data: Data) -> Evidence:
    return Evidence([damping_exponent(data, "fig09b")], caveat=_other_fits(data, "fig09b"))


def relation(data: Data) -> Evidence:
    """2 - 1/xi minus the exponent of kappa. Literal: with xi of the pulse's peaks, for both gamma; intended, in equilibrium: with xi of
    the sound peak."""
    found, told = [], []
    for panel, gamma in (("fig09a", "N"), ("fig09b", 1)):
        kappa, law = exponent(largest_sizes(sizes(data, gamma)), "")
        told.append(f"{law.chi_square:.1f} for {law.freedom} at γ = {gamma}")
        found.append(_excess(damping_exponent(data, panel), kappa, f"γ = {gamma}"))
    heat, _ = equilibrium(data)
    limit = where_made(lambda: [_excess(_sound(data), one, f"equilibrium, {one.label}") for one in heat])
    return Evidence(
        found,
        limit,
        caveat="ξ is that of moving peaks, which fig. 10 measures; sound has 2/3, which gives 1/2, and κ has 1/3. With the peak of heat "
        f"at the centre, ξ = 3/5, the relation gives 1/3; that one is not tested here. κ of fig. 8 is fitted over the largest sizes, with χ² of {' and '.join(told)}.",
    )


def _excess(peak: Number, kappa: Number, name: str) -> Number:
    slope = peak.value**-2
    expected = Number("", 2 - 1 / peak.value, slope * peak.error, peak.freedom, slope * peak.systematic)
    return combination([expected, kappa], [1, -1], f"2 - 1/ξ minus exponent of κ, {name}")


CLAIMS: dict[str, Claim] = {
    "C25": peaks_leave,
    "C26": ballistic,
    "C27": damping,
    "C28": damping_rare,
    "C30": relation,
    "C35": speed_falls,
}

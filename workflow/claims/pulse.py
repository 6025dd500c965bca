"""Claims on the energy pulse (figs. 9 and 10), and on what links it to the conductivity."""

import math
from collections.abc import Sequence

import numpy as np

from workflow.claims.data import Data, MissingError, combination, mean_slope, number, where_made
from workflow.claims.evidence import Claim, Evidence
from workflow.claims.growth import exponent, largest_sizes, sizes
from workflow.claims.verdict import Number, with_systematic
from workflow.figures import ext03, fig10
from workflow.figures.fig09 import gaussian_start, start
from workflow.lib.fit import with_error
from workflow.lib.load import Quantity, Result

APART = 2  # standard errors


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


def _speeds(result: Result) -> str:
    speed = result["peak_speed"]
    known = np.flatnonzero(np.isfinite(speed.mean))
    if not len(known):
        return "No moving peak was found."
    told = [f"{_at(speed, k)} at t = {speed.axes['middle'][k]:.3g}" for k in known[[0, -1]]]
    return f"Speed of the peaks: {', '.join(told)}."


def _at(quantity: Quantity, k: int) -> str:
    return with_error(float(quantity.mean[k]), float(quantity.error[k]))


def ballistic(data: Data) -> Evidence:
    """Exponent of the peak's position between the first time and the last. Later first times, an earlier last one and the
    other start bound the systematic error."""
    result, other = _pulse(data, "fig09b"), _from_rest(data, "fig09b")
    others = [_way(result, first, last).value for first, last in ((1, -1), (2, -1), (0, -2))]
    rest = _way(other, 0, -1)
    found = _bounded(_way(result, 0, -1), others, rest)
    return Evidence([found], [found], caveat=f"{_speeds(result)} {_of_rest(found, rest)}")


def _way(result: Result, first: int, last: int) -> Number:
    """Exponent of the position between two of the times at which there is a moving peak."""
    place = result["peak_position"]
    known = np.flatnonzero(np.isfinite(place.mean))
    if first >= len(known) + last:
        raise MissingError("too few times with a moving peak")
    ends = known[[first, last]]
    one, two = (number(result, "peak_position", k) for k in ends)
    span = float(np.log(place.axes["time"][ends[1]] / place.axes["time"][ends[0]]))
    error = math.hypot(one.error / one.value, two.error / two.value) / span
    label = "d ln x_p/d ln t between the first and the last time, Gaussian start"
    return Number(label, math.log(two.value / one.value) / span, error, one.freedom)


def damping(data: Data) -> Evidence:
    found = damping_exponent(data, "fig09a")
    return Evidence(
        [found],
        [found],
        where_made(lambda: [_sound(data)]),
        caveat=_other_fits(data, "fig09a"),
    )


def _sound(data: Data) -> Number:
    """Exponent of the sound peak in the fluctuations of the largest ring. Fits that leave out up to half of the times, and what it
    is above the background, bound the systematic error."""
    rings = data.of("ext03", "correlation")
    largest = max(rings, key=lambda one: one.parameters["cells"])
    others = [*_later(largest["damping_exponent_from"]), -ext03.damping(largest, above=True).exponent]
    label = mean_slope(
        f"sound peak of the fluctuations, N = {largest.parameters['cells']}", ext03.damping(largest)
    )
    return with_systematic(number(largest, "damping_exponent", label=label), others)


def _later(fitted: Quantity) -> list[float]:
    """Exponents of the fits that leave out up to half of the times."""
    return [float(one) for one in fitted.mean[1 : len(fitted.mean) // 2 + 1]]


def damping_exponent(data: Data, panel: str) -> Number:
    """Fits that leave out up to half of the times, and the other start, bound the systematic error."""
    result = _pulse(data, panel)
    drifts, _ = fig10.drift(result)
    label = "damping exponent, Gaussian start" + (", a mean slope" if drifts else "")
    found = number(result, "damping_exponent", label=label)
    rest = number(_from_rest(data, panel), "damping_exponent")
    return _bounded(found, _later(result["damping_exponent_from"]), rest)


def _other_fits(data: Data, panel: str) -> str:
    result = _pulse(data, panel)
    fitted = result["damping_exponent_from"]
    half = len(fitted.mean) // 2
    drifts, change = fig10.drift(result)
    found, rest = (number(one, "damping_exponent") for one in (result, _from_rest(data, panel)))
    return (
        f"{'No power of t describes' if drifts else 'A power of t describes'} the height: its exponent {change}. Fitted from "
        f"t = {fitted.axes['from'][half]:g} on it is {_at(fitted, half)}. {_of_rest(found, rest)}"
    )


def damping_rare(data: Data) -> Evidence:
    return Evidence([damping_exponent(data, "fig09b")], caveat=_other_fits(data, "fig09b"))


def relation(data: Data) -> Evidence:
    """2 - 1/xi with xi of the moving peak, minus the exponent of kappa."""
    found, told = [], []
    for panel, gamma in (("fig09a", "N"), ("fig09b", 1)):
        peak = damping_exponent(data, panel)
        slope = peak.value**-2
        expected = Number("", 2 - 1 / peak.value, slope * peak.error, peak.freedom, slope * peak.systematic)
        kappa, law = exponent(largest_sizes(sizes(data, gamma)), "")
        told.append(f"{law.chi_square:.1f} for {law.freedom} at γ = {gamma}")
        found.append(combination([expected, kappa], [1, -1], f"2 - 1/ξ minus exponent of κ, γ = {gamma}"))
    return Evidence(
        found,
        caveat="With ξ of the peak, as the paper does; the centre has no constant exponent (ext03). At γ = N no two of these numbers are "
        "exponents: both change with the times and sizes over which they are taken, so that the value says nothing by itself. κ is fitted "
        f"over the largest sizes, with χ² of {' and '.join(told)}.",
    )


CLAIMS: dict[str, Claim] = {
    "C25": peaks_leave,
    "C26": ballistic,
    "C27": damping,
    "C28": damping_rare,
    "C30": relation,
}

"""Claims on the energy pulse (figs. 9 and 10), and on what links it to the conductivity."""

import math

import numpy as np

from workflow.claims.data import Data, MissingError, combination, number, where_made
from workflow.claims.evidence import Claim, Evidence
from workflow.claims.growth import exponent, largest_sizes, sizes
from workflow.claims.verdict import Number, with_systematic
from workflow.figures.fig09 import gaussian_start
from workflow.lib.fit import with_error
from workflow.lib.load import Quantity, Result


def _pulse(data: Data, panel: str) -> Result:
    return gaussian_start(data.of(panel))


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
    """Exponent of the peak's position between the first time and the last."""
    result = _pulse(data, "fig09b")
    place = result["peak_position"]
    known = np.flatnonzero(np.isfinite(place.mean))
    if len(known) < 2:
        raise MissingError("no moving peak was found")
    first, last = (number(result, "peak_position", k) for k in known[[0, -1]])
    span = float(np.log(place.axes["time"][known[-1]] / place.axes["time"][known[0]]))
    error = math.hypot(first.error / first.value, last.error / last.value) / span
    found = Number("d ln x_p/d ln t", math.log(last.value / first.value) / span, error, first.freedom)
    return Evidence([found], [found], caveat=_speeds(result))


def damping(data: Data) -> Evidence:
    fitted = _pulse(data, "fig09a")["damping_exponent_from"]
    half = len(fitted.mean) // 2
    found = damping_exponent(data, "fig09a")
    return Evidence(
        [found],
        [found],
        where_made(lambda: _sound(data)),
        caveat=f"Fitted from t = {fitted.axes['from'][half]:g} on it is {_at(fitted, half)}.",
    )


def _sound(data: Data) -> Number:
    """Exponent of the sound peak in the fluctuations of the largest ring."""
    rings = data.of("ext03", "correlation")
    largest = max(rings, key=lambda one: one.parameters["cells"])
    later = largest["damping_exponent_from"].mean[1:2]
    label = f"sound peak of the fluctuations, N = {largest.parameters['cells']}"
    return with_systematic(number(largest, "damping_exponent", label=label), [float(one) for one in later])


def damping_exponent(data: Data, panel: str) -> Number:
    """Fits that leave out the first time, or the first two, bound the systematic error."""
    result = _pulse(data, panel)
    later = result["damping_exponent_from"].mean[1:3]
    return with_systematic(
        number(result, "damping_exponent", label="damping exponent"), [float(one) for one in later]
    )


def damping_rare(data: Data) -> Evidence:
    return Evidence([damping_exponent(data, "fig09b")])


def relation(data: Data) -> Evidence:
    """2 - 1/xi with xi of the moving peak, minus the exponent of kappa."""
    found = []
    for panel, gamma in (("fig09a", "N"), ("fig09b", 1)):
        peak = damping_exponent(data, panel)
        slope = peak.value**-2
        expected = Number("", 2 - 1 / peak.value, slope * peak.error, peak.freedom, slope * peak.systematic)
        kappa, _ = exponent(largest_sizes(sizes(data, gamma)), "")
        found.append(combination([expected, kappa], [1, -1], f"2 - 1/ξ minus exponent of κ, γ = {gamma}"))
    return Evidence(
        found, caveat="With ξ of the peak, as the paper does; the centre has no constant exponent (ext03)."
    )


CLAIMS: dict[str, Claim] = {
    "C25": peaks_leave,
    "C26": ballistic,
    "C27": damping,
    "C28": damping_rare,
    "C30": relation,
}

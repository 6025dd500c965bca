"""Claims on the energy pulse (figs. 9 and 10), and on its relation to the conductivity.

One rule for all: literal statements are judged from the paper's start, scatterers at rest that have relaxed. Other starts,
rings and pulses, and equilibrium, belong to the intended meaning or the alternative reading.
"""

import math
from dataclasses import replace

import numpy as np

from workflow.claims.data import Claim, Data, Evidence, MissingError, combination, number, where_made
from workflow.claims.growth import equilibrium, exponent, largest_sizes, sizes, without_particle_current
from workflow.claims.verdict import Number, with_systematic
from workflow.lib import style
from workflow.lib.caption import goodness, listed
from workflow.lib.fit import rejected, with_error
from workflow.lib.load import Quantity, Result
from workflow.lib.peaks import ORDERS, Record, heat_width, jackknife_error, stable_laws
from workflow.lib.pulse import gaussian_start, start
from workflow.lib.rings import chain

PAPERS_START = "paper's start"
HEAT = "heat"  # runs of ext. 3 for the heat peak
WIDE = 6  # cells; narrower heat peaks are not fitted
PRECISE = 2  # number of times that count: the first ones at which the heat peak is so wide
AT_BOUND = 0.01  # smallest distance of a fitted order from the bounds of the fit; closer ones are not determined by the profile
WIDE_FROM = 0.032  # time from which the peak of a weak pulse of one cell spans several
PEAK_BIAS = 0.02  # largest bias of the damping exponent of an octave (cpp/statistics/moving_peak.hpp)


def _gaussian(data: Data, panel: str) -> Result:
    return gaussian_start(data.of(panel))


def _from_rest(data: Data, panel: str) -> Result:
    """The paper's start, in which scatterers at rest have relaxed."""
    return next(result for result in data.of(panel) if start(result) != "particles")


def peaks_leave(data: Data) -> Evidence:
    """Fraction of the energy in the five central cells at the last time, and odd part at the peak over the peak at every time."""
    rest, gaussian = _from_rest(data, "fig09a"), _gaussian(data, "fig09a")
    return Evidence(_left(rest), _left(gaussian), caveat=_speeds(rest))


def _left(result: Result) -> list[Number]:
    share = number(result, "centre_share", -1, "share of the five central cells at the last time")
    return [share, *_odd_parts(result)]


def _odd_parts(result: Result) -> list[Number]:
    height, position, odd = result["peak"].mean, result["peak_position"].mean, result["odd_part"]
    distance, times = odd.axes["distance"], odd.axes["time"]
    numbers = []
    for k in np.flatnonzero(np.isfinite(position)):
        nearest = int(np.abs(distance - position[k]).argmin())
        label = f"odd part over the peak, t = {times[k]:g}"
        numbers.append(number(result, "odd_part", (k, nearest), label).over(height[k]))
    return numbers


def _speeds(result: Result, where: str = "") -> str:
    """Sentence of a caveat with the first and the last speed of the peaks."""
    speed = result["peak_speed"]
    resolved = np.flatnonzero(np.isfinite(speed.mean))
    if not len(resolved):
        return f"No moving peak was found{where}."
    ends = [f"{style.with_error(speed, k)} at t = {speed.axes['middle'][k]:.3g}" for k in resolved[[0, -1]]]
    return f"Speed of the peaks{where}: {', '.join(ends)}."


def ballistic(data: Data) -> Evidence:
    """Exponent of the peak's position: literal, from the paper's start; intended, in a ring ten times as long at later times, where the
    width of the cell in which the pulse begins no longer counts."""
    rest, long = _from_rest(data, "fig09b"), data.one("ext14", "long")
    return Evidence(
        [_way(rest, PAPERS_START)],
        [_way(long, f"N = {long.parameters['cells']}")],
        caveat=f"{_speeds(rest)} {_speeds(long, ' in the long ring')}",
    )


def _way(result: Result, name: str) -> Number:
    """Exponent of the position between the first and the last time with a moving peak. The exponents without the first or
    without the last of them bound the systematic error."""
    resolved = np.flatnonzero(np.isfinite(result["peak_position"].mean))
    if len(resolved) < 3:
        raise MissingError("too few times with a moving peak")
    times = result["peak_position"].axes["time"][resolved[[0, -1]]]
    label = f"d ln x_p/d ln t, {name}, t = {times[0]:g} to {times[1]:g}"
    slope, *alternatives = (_between(result, *resolved[list(ends)]) for ends in ((0, -1), (1, -1), (0, -2)))
    return with_systematic(replace(slope, label=label), [alternative.value for alternative in alternatives])


def _between(result: Result, first: int, last: int) -> Number:
    time = result["peak_position"].axes["time"]
    early, late = (number(result, "peak_position", k) for k in (first, last))
    return _log_slope("", early, late, time[last] / time[first])


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
    resolved = np.flatnonzero(speed.mean > 0)
    if len(resolved) < 2:
        raise MissingError("too few times with a moving peak")
    first, last = (number(result, "peak_speed", k) for k in resolved[[0, -1]])
    time = speed.axes["middle"][resolved]
    return _log_slope(f"d ln v/d ln t, {name}", first, last, time[-1] / time[0])


def damping(data: Data) -> Evidence:
    """Damping exponents. Literal: of every octave of the paper's pulse, which agree for a power law. Intended: of sound in equilibrium, as
    the pulse is a shock. Alternative: of a pulse with a tenth of the energy, from the time on at which its peak spans several cells."""
    rest, weak = _from_rest(data, "fig09a"), data.one("ext14", "weak")
    sound = _sound(data)
    return Evidence(
        _octaves(rest),
        [sound],
        [_from_time(weak, WIDE_FROM, "a tenth of the energy")],
        caveat=f"Over all times it is {style.with_error(rest['damping_exponent'])} from the paper's start, and changes by {style.with_error(rest['damping_drift'])} "
        f"per unit of ln t. The paper's pulse is a shock. {_speeds(rest)} With a tenth of the energy it is "
        f"{style.with_error(weak['damping_exponent'])} over all times, and changes by {style.with_error(weak['damping_drift'])} per unit of ln t.",
    )


def _from_time(result: Result, first: float, name: str) -> Number:
    """Damping exponent of the fit that begins at this time. Fits that begin later bound the systematic error."""
    fits = result["damping_exponent_from"]
    k = int(np.flatnonzero(fits.axes["from"] >= first)[0])
    label = f"damping exponent, {name}, from t = {fits.axes['from'][k]:g} on"
    return with_systematic(number(result, "damping_exponent_from", k, label), _later(fits)[k:])


def _octaves(result: Result) -> list[Number]:
    """Damping exponents by octave of time; the fits of the peak's height bound their systematic errors."""
    local = result["local_damping_exponent"]
    octaves = [
        number(
            result, "local_damping_exponent", k, f"damping exponent, {PAPERS_START}, octave to t = {until:g}"
        )
        for k, until in enumerate(local.axes["until"])
        if np.isfinite(local.mean[k])
    ]
    return [with_systematic(octave, [octave.value + PEAK_BIAS]) for octave in octaves]


def _of_all_times(result: Result, label: str) -> Number:
    """Damping exponent over all times. Fits that leave out up to half of the times bound the systematic error."""
    slope = number(result, "damping_exponent", label=label)
    return with_systematic(slope, _later(result["damping_exponent_from"]))


def _sound(data: Data) -> Number:
    """Damping exponent of the sound peak in equilibrium, of the longest record."""
    rings = [ring for ring in data.of("ext03", "correlation") if not ring.run.startswith(HEAT)]
    longest = max(rings, key=lambda ring: float(ring["peak"].axes["time"][-1]))
    return _of_all_times(longest, f"sound peak in equilibrium, N = {longest.parameters['cells']}")


def heat_peak(data: Data) -> tuple[Number, str]:
    """Order 1/xi of the stable law fitted to the heat peak in equilibrium, and a sentence with the orders by time.

    The order is the unweighted mean over the first PRECISE times at which the peak is several cells wide. Later times are less precise,
    and weights from the errors of so few runs would be noise. The error is that of a jackknife over equal runs, as neighbouring cells and
    times are correlated. The change without the first time is a systematic error. Raises MissingError."""
    runs = [run for run in data.of("ext03", "correlation") if run.run.startswith(HEAT)]
    if len(runs) < 2:
        raise MissingError("ext03 has fewer than two runs of the heat peak")
    gas = chain(runs[0])
    times, widths, by_time = [], [], []
    for k, time in enumerate(map(float, runs[0]["heat_correlation"].axes["time"])):
        record = Record(runs, k, time, gas, chain(runs[0], time))
        width = heat_width(record) / gas.cell_length
        if width < WIDE:
            continue
        law, without_one = stable_laws(record)
        orders = np.append(law[-1], without_one[:, -1])
        low, high = ORDERS
        if low + AT_BOUND < orders.min() and orders.max() < high - AT_BOUND:
            times.append(time)
            widths.append(width)
            by_time.append(orders)
    if not by_time:
        raise MissingError("the profiles determine no order of the heat peak at this quality")
    full, without = np.array(by_time)[:, 0], np.array(by_time)[:, 1:]
    errors = jackknife_error(without.T)
    error = float(jackknife_error(without[:PRECISE].mean(axis=0)))
    order = Number("order of the heat peak", float(full[:PRECISE].mean()), error, len(runs) - 1)
    later = [float(full[1:PRECISE].mean())] if len(full) > 1 else []
    crossing = [width / gas.sound_speed_in_cells for width in widths]
    sentence = (
        f"Stable laws fitted to the heat peak in equilibrium have the orders {listed(map(with_error, full, errors))} at "
        f"t = {listed(f'{time:g}' for time in times)}. The peak is then {widths[0]:.0f} to {widths[-1]:.0f} cells wide, so that it tests currents at "
        f"the times {crossing[0]:.0f} to {crossing[-1]:.0f} in which sound crosses it."
    )
    return with_systematic(order, later), sentence


def _later(fitted: Quantity) -> list[float]:
    """Exponents of the fits that leave out up to half of the times."""
    return [float(slope) for slope in fitted.mean[1 : len(fitted.mean) // 2 + 1]]


def _drift(result: Result) -> tuple[bool, str]:
    """Whether the exponent changes significantly with ln t, and a clause of the caveat on this change."""
    change = result["damping_drift"]
    value, error = float(change.mean), float(change.error)
    if not np.isfinite(value):
        return False, "may change unseen, over too few octaves"
    chi_square = (value / error) ** 2
    text = f"changes by {with_error(value, error)} per unit of ln t, {goodness(chi_square, 1)}"
    return rejected(chi_square, 1), text


def _damping_exponent(result: Result, name: str) -> Number:
    drifts, _ = _drift(result)
    return _of_all_times(result, f"damping exponent, {name}" + (", a mean slope" if drifts else ""))


def damping_rare(data: Data) -> Evidence:
    """Damping exponents. Literal: from the paper's start. Intended: from momenta that are all Gaussian, whose errors are smaller."""
    rest, gaussian = _from_rest(data, "fig09b"), _gaussian(data, "fig09b")
    fits = gaussian["damping_exponent_from"]
    half = len(fits.mean) // 2
    drifts, change = _drift(gaussian)
    return Evidence(
        [_damping_exponent(rest, PAPERS_START)],
        [_damping_exponent(gaussian, "Gaussian start")],
        caveat=f"{'No power of t describes' if drifts else 'A power of t describes'} the height from the Gaussian start: its exponent "
        f"{change}. Fitted from t = {fits.axes['from'][half]:g} on it is {style.with_error(fits, half)}.",
    )


def relation(data: Data) -> Evidence:
    """2 - 1/xi minus the exponent of kappa, where xi is a damping exponent. Literal: with xi of the pulse's moving peaks, for both gamma. Intended: with xi of the heat
    peak at the centre in equilibrium, and kappa_0. Alternative: with xi of the sound peaks, which move."""
    excesses, fits = [], []
    for panel, gamma in (("fig09a", "N"), ("fig09b", 1)):
        kappa, law = exponent(largest_sizes(sizes(data, gamma)), "")
        fits.append(f"{law.chi_square:.1f} for {law.freedom} at γ = {gamma}")
        excesses.append(
            _excess(_damping_exponent(_from_rest(data, panel), PAPERS_START), kappa, f"pulse, γ = {gamma}")
        )
    kappa_0 = without_particle_current(data)
    order, orders = heat_peak(data)
    central = combination(
        [order, kappa_0], [-1, -1], "2 - 1/ξ minus exponent of κ, heat peak in equilibrium, κ_0", -2
    )
    rings = listed(with_error(slope.value, slope.error) for slope in equilibrium(data))
    return Evidence(
        excesses,
        [central],
        where_made(lambda: [_excess(_sound(data), kappa_0, "sound in equilibrium, κ_0")]),
        caveat="The paper states the relation for the central peak, and asks whether moving ones obey it too; fig. 10 measures those. "
        f"{orders} With 1/ξ = {with_error(order.value, order.error)}, the mean of the first two, 2 - 1/ξ is {with_error(2 - order.value, order.error)}. κ_0 has the exponent "
        f"{with_error(kappa_0.value, kappa_0.error)}, ⟨Q²⟩/t in equilibrium {rings} (C24). Sound has ξ = 2/3, which gives 1/2. "
        f"κ of fig. 8 is fitted over the largest sizes, with χ² of {' and '.join(fits)}.",
    )


def _excess(peak: Number, kappa: Number, name: str) -> Number:
    """2 - 1/xi minus the exponent of kappa, with xi of a peak."""
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

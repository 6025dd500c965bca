"""Results as they would be if the world were one in which a claim holds, or one in which it does not: by panel, the truth of the
quantities that matter."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tests.python.known_results import Truth
from workflow.lib.plan import Run

COLD, HOT = 900 / 11, 1100 / 9  # the baths

World = Mapping[str, Truth]  # by panel


def rare(run: Run) -> bool:
    """gamma = 1."""
    return bool(run.options["gamma"] == 1)


def law(run: Run) -> float:
    return float(np.arccos(run.options["sigma"]) / np.pi)


def gaussian(temperature: float, factor: float) -> Any:
    return lambda _run, _place, p: factor * np.exp(-(p**2) / 2 / temperature) / np.sqrt(2 * np.pi * temperature)  # fmt: skip


def equilibrium(temperature: float) -> World:
    return {"ext10": {"flux": gaussian(temperature, 400), "scatterer_density": gaussian(temperature, 1),
                      "square": temperature, "kurtosis": 3, "temperature_scatterer": temperature}}  # fmt: skip


def finite(amplitude: float, exponent: float = -1, middle: float = 0, odd: float = 0.2) -> World:
    """F is Gaussian; F_N deviates by a bump at +-middle, as printed of this size for one cell."""

    def flux(run: Run, _place: np.ndarray, p: np.ndarray) -> np.ndarray:
        cells = run.options["cells"]
        size = 0 if cells == "continuum" else 400 * amplitude * cells**exponent
        bump = np.exp(-((abs(p) - middle) ** 2) / 50) * (1 + odd * np.sign(p))
        found: np.ndarray = gaussian(102, 400)(run, _place, p) + size * bump
        return found

    return {"fig03_inset": {"flux": flux}}


def profile(**given: Any) -> World:
    return {"fig02_upper": given}


def straight(steep: float, less: float) -> World:
    """Temperature difference between the ends over that of the baths, at gamma = N and 1."""

    def temperature(run: Run, cell: np.ndarray) -> np.ndarray:
        return (COLD + HOT) / 2 + (less if rare(run) else steep) * (HOT - COLD) * (cell / 29 - 0.5)

    return profile(temperature_scatterer=temperature)


def densities(slope: tuple[float, float], excess: tuple[float, float]) -> World:
    """At gamma = N and 1."""
    return profile(
        density_slope=lambda run: slope[rare(run)], density_excess=lambda run, _: excess[rare(run)]
    )


def rates(deviation: float) -> World:
    names = ("rate_right_deviation", "rate_left_deviation", "particle_current_deviation")
    return profile(rate_right=200, **dict.fromkeys(names, deviation))


def jumping(height: float) -> World:
    """A flux of 10 that changes by so much at p = 0."""
    return {"fig04b": {"jump": height, "flux": lambda _, place, p: 10 + height * (p > 0)}}


def halves(paper: float, exchange: float = 3.07, equal: float = 3.0, jump: float = 4) -> World:
    kurtosis = {"paper": paper, "exchange": exchange, "equal": equal}
    return {"fig03": {"flux_density": 10, "jump": jump, "kurtosis": lambda run, *_: kurtosis[run.name]}}


def chain(plateau: float = 15, slope: float = 15, curvature: float = 0, growth: float = 0) -> World:
    """growth: power of time with which the plateau grows."""
    given = {
        "log_slope": slope,
        "log_curvature": curvature,
        "plateau": lambda _, t: plateau * (t / 1800) ** growth,
    }
    return {"fig01": given}  # fmt: skip


def fronts(exponent: float, others: float) -> World:
    return {"fig01": {"front": lambda _, t: 1 / t,
                      "front_exponent": lambda run: exponent if run.name == "unit-chain" else others}}  # fmt: skip


def jumps(deterministic: float, rare_: float) -> World:
    return {"fig04a": {"jump": rare_, "flux": 1}, "fig04b": {"jump": deterministic}}


def waits(exponent: float, spread: float = 0) -> World:
    return {"fig06": {"exponent": exponent, "exponent_spread": spread}}


def waits_aged(exponent: float, aged: float, spread: float = 0) -> World:
    return {**waits(exponent, spread), "ext07": {"exponent": aged}}


def spreads(panel: str, alpha: float, aged: float) -> World:
    return {panel: {"alpha": alpha}, "ext01": {"alpha": aged}}


def every_sigma(free: float, zero: float) -> World:
    return {"fig07_inset": {"alpha": lambda run: zero if run.options["zero-total-momentum"] else free}}


def drop_per_cell(run: Run) -> float:
    """Of the temperature, from the left bath to the right one."""
    return float(run.options["temperature-left"] - run.options["temperature-right"]) / run.options["cells"]


def kappas(deterministic: float, rare_: float, end: float = 0, fixed: float = 1 / 3) -> World:
    """Powers of N; end: part of kappa by which small chains at gamma = N are off, falling as 1/N. fixed: power at fixed density, in
    equilibrium and in linear response."""

    def kappa(run: Run) -> float:
        size = run.options["cells"]
        return float(size**rare_ if rare(run) else size**deterministic * (1 + end / size))

    def current(run: Run) -> float:
        return kappa(run) * drop_per_cell(run)

    both = {"stationary": 1, "kappa": kappa, "kappa_particle": kappa, "energy_current": current}
    response = {**linear_response(lambda cells: cells**fixed), "stationary": 1}
    return {"fig08": both, "ext09": both, "ext11": response, **equilibrium_heat(fixed)}


def rare_kappas(power: float) -> World:
    """Of fig. 8 alone."""
    return {"fig08": kappas(1, power)["fig08"]}


def linear_response(kappa_0: Callable[[int], float]) -> Truth:
    """Currents between two baths at a small difference of temperature or pressure; the thinning gas has another L_un."""

    def current(name: str) -> Callable[[Run], float]:
        def of_run(run: Run) -> float:
            o, cells = run.options, run.options["cells"]
            left, right = ((o[f"temperature-{end}"], o[f"nu-{end}"]) for end in ("left", "right"))
            heat = 1 / right[0] - 1 / left[0]
            drift = math.log(left[1] / right[1] * math.sqrt(right[0] / left[0]))
            nn, un = 3 * cells, 70 * cells * (5 if o["cell-length"] == "1/N" else 1)
            uu = 1e4 * kappa_0(cells) + un**2 / nn
            row = (uu, un) if name == "energy_current" else (un, nn)
            return float((row[0] * heat + row[1] * drift) / cells)

        return of_run

    names = ("energy_current", "particle_current")
    return {name: current(name) for name in names} | {"current_correlation": 0.0}


def pulse(panel: str, **given: Any) -> World:
    """On a ring that has not closed."""
    shape = {
        "peak": 1,
        "peak_raw": 1,
        "peak_position": 10,
        "energy_difference": lambda _run, _t, x: (x > 1) & (x < x.max() - 1),
    }
    return {panel: {**shape, "peak_speed": 300, "odd_part": 0, **given}}


def ballistic(power: float, long: float) -> World:
    """In the paper's ring and in the long one."""
    return {
        **pulse("fig09b", peak_position=lambda _, t: 300 * t**power),
        **pulse("ext14", peak_position=lambda _, t: 300 * t**long),
    }


def damped(panel: str, exponent: float, later: float | None = None) -> World:
    fits = {"damping_exponent": exponent, "damping_exponent_from": exponent if later is None else later}
    return pulse(panel, damping_drift=0, local_damping_exponent=exponent, **fits)


def shock(exponent: float, weak: float, later: float | None = None) -> World:
    """Damping of the paper's pulse and of a weak one."""
    return {**damped("fig09a", exponent), **damped("ext14", weak, later)}


def slowing(power: float) -> World:
    """Of the peaks' speed; power of time."""
    speed = {"peak_speed": lambda _, t: 300 * t**power}
    return {**pulse("fig09a", **speed), **pulse("ext14", **speed)}


def equilibrium_heat(power: float) -> World:
    """Exponent of the conductivity that the heat in equilibrium has."""
    return {"ext13": {"local_exponent": 1 + power}}


def linked(conductivity: float, shift: float = 0, sound: float = 3 / 5) -> World:
    """2 - 1/xi of the pulses is 1/3 and 1, less the shift."""
    peaks = damped("fig09a", 1 / (5 / 3 + shift)), damped("fig09b", 1 / (1 + shift))
    of_sound = {"damping_exponent": sound, "damping_exponent_from": sound, "peak": 1}
    equilibrium = {"ext03": of_sound, **equilibrium_heat(1 / 3)}
    return {**peaks[0], **peaks[1], **equilibrium, "fig08": kappas(conductivity, 1)["fig08"]}


def ageing(power: float, last: float = 1, few: float = 0) -> World:
    """The slope against ln t grows as a power of t, but for the last decade; few: what that is in the chain of few particles."""

    def slope(run: Run, t: np.ndarray) -> np.ndarray:
        end = few if run.name == "few" else last
        return 100 * t**power * np.where(t == t.max(), end, 1)

    return {"ext07": {"decade_slope": slope}}


def excess(power: float) -> World:
    """Excess of the end cells against ln N."""
    both = {"density_excess": lambda run, _: 1 + power * np.log(run.options["cells"])}
    return {"ext05": both, "fig02_upper": both}


def persistent(shift: float, limits: float = 0) -> World:
    return {"fig05": {"mu": lambda run: law(run) + (shift if abs(run.options["sigma"]) < 1 else limits)}}


def drift(size: float) -> World:
    return {"fig07_inset": {"momentum_drift": size}}

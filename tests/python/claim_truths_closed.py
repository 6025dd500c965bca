"""Exact results as in claim_truths.py, for the claims on closed chains, conductivity against size, and pulses."""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from tests.python.claim_truths import EXACT, Answer, World, claim, named, rare
from tests.python.known_results import Truth, plan
from workflow.lib.peaks import stable_densities
from workflow.plan import Run


def law(run: Run) -> float:
    """Law of the persistence, arccos(sigma)/pi."""
    return float(np.arccos(run.options["sigma"]) / np.pi)


def drop_per_cell(run: Run) -> float:
    """Temperature drop per cell, from the left bath to the right one."""
    return float(run.options["temperature-left"] - run.options["temperature-right"]) / run.options["cells"]


def linear_response(kappa_0: Callable[[int], float]) -> Truth:
    """Currents between baths with a small difference of temperature or pressure. kappa_0: conductivity at J_n = 0 as a function of N.
    The thinning gas has another coefficient L_un."""

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
    """Pulse of a panel in a ring that has not closed, with the given quantities and defaults for all others."""
    shape = {
        "peak": 1,
        "peak_raw": 1,
        "peak_position": 10,
        "energy_difference": lambda _run, _t, x: (x > 1) & (x < x.max() - 1),
    }
    return {panel: {**shape, "peak_speed": 300, "odd_part": 0, **given}}


def heat_peak(order: float, narrow: float | None = None) -> Callable[..., np.ndarray]:
    """Heat peak: a stable law about the central cell, about 7 cells wide at t = 256. Earlier peaks have the order `narrow`. The area differs
    between runs. Runs that are meant for sound have a constant profile."""

    def profile(run: Run, t: np.ndarray, _cell: np.ndarray) -> np.ndarray:
        if not run.series.startswith("heat"):
            return np.ones_like(t)
        area = 0.1 + 0.01 * int(run.name.partition("-")[2])
        return area * stable_peaks(run.options["times"], run.options["cells"], order, narrow or order)

    return profile


@cache
def stable_peaks(times: str, cells: int, order: float, narrow: float) -> np.ndarray:
    """Profiles of heat_peak() of unit area [time, cell]."""
    t, cell = np.meshgrid(np.array(times.split(","), float), np.arange(cells), indexing="ij")
    width = 0.25 * t**0.6
    densities = stable_densities().ev(abs(cell - cells // 2) / width, np.where(t < 200, narrow, order))
    return np.asarray(densities / width)


def of_runs(panel: str, value: Callable[[Run], float], chosen: Callable[[Run], bool]) -> list[float]:
    """Values of the runs of a panel that satisfy a condition."""
    return [value(run) for run in plan("paper")[panel].runs if chosen(run)]


# Persistence: the law plus a shift that depends on sigma and is twice as large in the dense chain.
def shift(run: Run) -> float:
    return float((0.02 if run.series == "dense" else 0.01) * (2 + run.options["sigma"]))


dense, paper = (
    of_runs("fig05", shift, lambda run, name=name: run.series == name) for name in ("dense", "paper")
)
claim("C15", {"fig05": {"mu": lambda run: law(run) + shift(run)}}, [0.01, 0.02, 0.03], dense, paper)

# Exponents of waiting times by relaxation time, of which 1 does not count. The spread over cuts of the tail is 0.1.
aged = {1: 9, 10: -2.05, 100: -1.8, 1000: -2.1}
waits = {"fig06": {"exponent": named({"all_sigma=0.5": -2, "all_sigma=0": -3}), "exponent_spread": 0.1}}
claim("C16", {**waits, "ext07": {"exponent": lambda run: aged[run.options["relaxation-time"]]}}, [(-2, 0.3)])
claim("C17", waits, [(-3, 0.1)])


# Spreading: alpha depends on sigma, particles per cell, relaxation time, total momentum and collision rule.
def alpha(run: Run) -> float:
    o = run.options
    zero, later = o.get("zero-total-momentum", False), o["relaxation-time"] == 1000
    found = 1.8 + 0.1 * o["sigma"] - 0.4 * zero - 0.03 * later + 0.01 * (o["particles-per-cell"] == 80)
    return float(found - 0.7 * run.series.startswith("random"))


spreading = {panel: {"alpha": alpha} for panel in ("fig07", "fig07_inset", "ext01")}
free = [f"all_sigma={sigma}" for sigma in (0.9, 0.75, 0.6, 0.45, 0.3, 0.15)]
zero = of_runs(
    "ext01", alpha, lambda run: run.options["sigma"] == 0.5 and bool(run.options.get("zero-total-momentum"))
)
claim("C18", spreading, [(1.85, 0.03)], (), zero)
claim("C19", spreading, [(1.8, 0.03)], (), [1.81])
sigmas = [0.01 * k for k in (-90, -75, -60, -45, -30, -15, 15, 30, 45, 60, 75, 90)]
claim("C20", spreading, [1.8 + 0.1 * sigma for sigma in sigmas], [1.4 + 0.1 * sigma for sigma in sigmas])
found = of_runs("ext01", alpha, lambda run: run.series.startswith("random"))
claim("C21", spreading, found, found)
drift = {"fig07_inset": {"momentum_drift": lambda run: 10 ** (-3 - alpha(run))}}
claim("C22", drift, [-4.8 - 0.1 * sigma for sigma in sigmas] + [-4.4 - 0.1 * sigma for sigma in sigmas])


# Ageing: slope of the energy by decade. In the longest run it is 100 in the first decade from t = 1 on, 200 in the second and 150 in the
# last. In the chain of few particles it is 60 before t = 1, then 40, and 3 in the last decade.
def slopes(run: Run, decade: np.ndarray) -> np.ndarray:
    if run.name == "few":
        return np.select([decade == decade.max(), np.isclose(decade, 1), decade < 0.9], [3.0, 40, 60], 20)
    found = np.select(
        [np.isclose(decade, 1), np.isclose(decade, 10), decade == decade.max()], [100, 200, 150], 90
    )
    return found * (1.0 if run.name == "long" else 3)


ageing = {"ext07": {"decade_slope": slopes}}
claim("C29", ageing, [0.5], [3 / 40], quality="deep")
claim("C29, without the two long runs", ageing, [0.5], quality="standard")


# Conductivity. At gamma = 1 kappa is N, but smaller by a factor of e^-0.002 at 128, the first of the five sizes within a factor of 16 of
# the largest. The sizes are equally spaced in ln N, so this changes the slope by 0.002/5 over the spacing. At gamma = N kappa is sqrt(N) up
# to 256 and N^0.2 beyond. With the temperatures of the particles its exponent is 0.03 larger, with those of the baths 0.05 smaller. The
# runs at N = 64 are not stationary.
def kappa(run: Run) -> float:
    size = run.options["cells"]
    if size == 64 or (size < 128 and rare(run)):
        return float(1000 * size)
    if rare(run):
        return float(size * math.exp(-0.002 * (size == 128)))
    powers = {"thinning": 0.1, "dilute": 0.3, "dense": 0.4}
    gas = run.series.partition("-")[0]
    if gas in powers:  # the two largest are 256 and 512, or 1024 and 2048
        return float(size ** powers[gas] * (1 + (size < 256)))
    return float(256**0.5 * (size / 256) ** (0.5 if size < 256 else 0.2)) * (1 + (size < 16))


both = {
    "kappa": kappa,
    "kappa_particle": lambda run: kappa(run) * run.options["cells"] ** 0.03,
    "energy_current": lambda run: kappa(run) * run.options["cells"] ** -0.05 * drop_per_cell(run),
    "stationary": lambda run: float(run.options["cells"] != 64),
}
rare_exponent = (1 + 4e-4 / math.log(2), 4e-4 / math.log(2))
claim("C23", {"fig08": both}, [rare_exponent])
response = {**linear_response(lambda size: size**0.3), "stationary": 1, "current_correlation": 0}
# Exponent over the last octave by ring; over the octave before it is 0.02 smaller. Rings differ by gas and length.
last = {"light-longest": 1.31, "dense-longest": 1.32, "dilute-longest": 1.34, "sparse-longest": 1.35}


def octaves(run: Run, middle: np.ndarray) -> np.ndarray:
    return last.get(run.name, 1.5) - 0.02 * (middle != middle.max()) - 0.1 * (middle < 0.4 * middle.max())


heat = {"ext13": {"local_exponent": octaves}}
claim(
    "C24", {"fig08": both, "ext09": both, "ext11": response, **heat}, [0.5, 0.2],
    [(0.31, 0.02), (0.32, 0.02), (0.34, 0.02), (0.35, 0.02), 0.3], [(0.2, 0.05), (0.1, 0.05), (0.3, 0.05), (0.4, 0.05)],
)  # fmt: skip


# At the k-th time the peak is at 5.2 + 3k cells and 100 + 10k high; there is none at the first and at the last time. The odd part per cell
# is 0.001 of the height, and twice that from the Gaussian start, which has one more time.
def place(_run: Run, t: np.ndarray) -> np.ndarray:
    k = np.arange(len(t))
    return np.where((k == 0) | (k == len(t) - 1), np.nan, 5.2 + 3 * k)


def odd(run: Run, t: np.ndarray, x: np.ndarray) -> np.ndarray:
    return 1e-3 * (1 + (run.name == "gaussian")) * x * (100 + 10 * np.arange(len(t))[:, None])


leaving = pulse("fig09a", peak=lambda _, t: 100 + 10 * np.arange(len(t)), peak_position=place, odd_part=odd,
                centre_share=lambda _, t: 0.1 + t)  # fmt: skip
left = [0.2, *(1e-3 * (5 + 3 * k) for k in range(1, 8))]
claim(
    "C25", leaving, left, [0.22, *(2e-3 * (5 + 3 * k) for k in range(1, 9))], peak=EXACT, peak_position=EXACT
)


# The peak moves ballistically except at the last time, at which it is e^d times farther. Without that time the exponent is 1.
def farther(d: float) -> Callable[..., np.ndarray]:
    return lambda run, t: (
        (300 if run.name != "gaussian" else 1)
        * t ** (1 if run.name != "gaussian" else 2)
        * np.where(t == t.max(), math.exp(d), 1)
    )


def ballistic(d: float, first: float, second: float, end: float) -> tuple[float, float]:
    bounds = (d / math.log(end / first), d / math.log(end / second) - d / math.log(end / first))
    return 1 + bounds[0], max(bounds)


claim(
    "C26", {**pulse("fig09b", peak_position=farther(0.02)), **pulse("ext14", peak_position=farther(0.05))},
    [ballistic(0.02, 0.01, 0.0125, 0.025)], [ballistic(0.05, 0.02, 0.04, 0.16)],
)  # fmt: skip


# Damping exponents. Each fit that begins one time later gives an exponent that is 0.01 larger. That of the other start differs by 0.5.
def later(exponent: float, step: float = 0.01) -> Callable[..., np.ndarray]:
    return lambda run, _: exponent + step * np.arange(len(str(run.options["times"]).split(",")) - 1)


def damped(panel: str, gaussian: float, rest: float, **others: Any) -> dict[str, dict[str, Any]]:
    def of_start(run: Run) -> float:
        return rest if run.name in ("rest", "weak") else gaussian

    fits = {
        "damping_exponent": of_start,
        "damping_exponent_from": lambda run, t: later(of_start(run))(run, t),
    }
    return pulse(panel, damping_drift=0, **fits, **others)


local = {
    "local_damping_exponent": lambda run, _: np.array([0.5, 0.6, 0.7, 0.8]) if run.name == "rest" else 9.0
}
rings = {"light": 0.9, "light-long": 0.8, "dense": 0.7, "dense-long": 0.55}


sound = {
    "damping_exponent": lambda run: rings.get(run.name, 3),
    "damping_exponent_from": lambda run, _: later(rings.get(run.name, 3))(run, 0),
    "peak": 1,
}
sound_exponent = (0.8, 0.03)  # of the first of the longest records, which have 8 times
damping = {**damped("fig09a", 0.66, 1.16, **local), **damped("ext14", 0.9, 0.6), "ext03": sound}
octave = [(0.1 * k, 0.02) for k in (5, 6, 7, 8)]
# The weak pulse is fitted from its fourth time on.
claim("C27", damping, octave, [sound_exponent], [(0.63, 0.01)])
claim("C28", damped("fig09b", 1, 1.5), [(1.5, 0.02)], [(1, 0.03)])

# 2 - 1/xi with xi = 0.66 and 0.9, and the exponents of kappa over the largest sizes; at gamma = N kappa is an exact power. kappa_0 ~ N^0.3.
# Heat peaks have the order 1.7, but 1.3 while they are less than 6 cells wide.
of_peaks = {**sound, "heat_correlation": heat_peak(1.7, 1.3)}
linked = {
    **damped("fig09a", 1.16, 0.66),
    **damped("fig09b", 1.4, 0.9),
    "ext03": of_peaks,
    "ext11": response,
    **heat,
}
kappa_n = {
    "kappa": lambda run: (
        kappa(run) if rare(run) else run.options["cells"] ** (0.2 if run.options["cells"] > 100 else 3)
    )
}
excess = [
    (2 - 1 / xi - value, fits / xi**2 + bound)
    for xi, fits, (value, bound) in ((0.66, 0.04, (0.2, 0)), (0.9, 0.02, rare_exponent))
]
xi, bound = sound_exponent
moving: Answer = [(2 - 1 / xi - 0.3, bound / xi**2)]
claim("C30", {**linked, "fig08": both | kappa_n}, excess, [2 - 1.7 - 0.3], moving, heat_correlation=0.03)


# Speeds fall as t^-0.1 and t^-0.4. They are NaN at the first time and twice as large at the third.
def speeds(run: Run, middle: np.ndarray) -> np.ndarray:
    k = np.arange(len(middle))
    power = {"rest": -0.1, "weak": -0.4}.get(run.name, -1)
    return 300 * middle**power * np.select([k == 0, k == 2], [np.nan, 2], 1)


claim("C35", {**pulse("fig09a", peak_speed=speeds), **pulse("ext14", peak_speed=speeds)}, [-0.1], (), [-0.4])

"""Exact results as in claim_truths.py, for the claims on closed chains, conductivity against size, and
pulses."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from tests.python.claim_truths import EXACT, World, claim, named, rare
from tests.python.conftest import planned
from workflow.pipeline.plan import Run


def law(run: Run) -> float:
    """Law of the persistence, arccos(sigma)/pi."""
    return float(np.arccos(run.options["sigma"]) / np.pi)


def pulse(panel: str, **given: Any) -> World:
    """Pulse of a panel in a ring that has not closed, with the given quantities and defaults for all
    others."""
    shape = {
        "peak": 1,
        "peak_position": 10,
        "energy_difference": lambda _run, _t, x: (x > 1) & (x < x.max() - 1),
    }
    return {panel: {**shape, "peak_speed": 300, "odd_part": 0, **given}}


def of_runs(panel: str, value: Callable[[Run], float], chosen: Callable[[Run], bool]) -> list[float]:
    """Values of the runs of a panel that satisfy a condition."""
    return [value(run) for run in planned("paper")[panel].runs if chosen(run)]


# Persistence: the law plus a shift that depends on sigma and is twice as large in the dense chain.
def shift(run: Run) -> float:
    return float((0.02 if run.series == "dense" else 0.01) * (2 + run.options["sigma"]))


persistences = {"fig05": {"mu": lambda run: law(run) + shift(run)}}
claim("closed.persistence_limits", persistences, [0.01, 0.02, 0.03])
dense = of_runs("fig05", shift, lambda run: run.series == "dense")
claim("closed.persistence_in_dense_chain", persistences, dense)
claim("closed.persistent", persistences, [1 / 3 + 0.025])
claim("closed.correlated", persistences, [1 / 6 - 0.025])

# Exponents of waiting times. The spread over cuts of the tail is 0.1, the change with the age 0.03.
waits = {
    "fig06": {
        "exponent": named({"all_sigma=0.5": -2, "all_sigma=0": -3, "young": -2.03}),
        "exponent_spread": 0.1,
    }
}
claim("closed.waiting_half", waits, [(-2, 0.13)])
claim("closed.waiting_zero", waits, [(-3, 0.1)])


# Spreading: alpha depends on sigma, particles per cell, relaxation time, total momentum and collision rule.
def alpha(run: Run) -> float:
    o = run.options
    zero, later = o.get("zero-total-momentum", False), o["relaxation-time"] == 1000
    found = 1.8 + 0.1 * o["sigma"] - 0.4 * zero - 0.03 * later + 0.01 * (o["particles-per-cell"] == 80)
    return float(found - 0.7 * (run.series == "random"))


spreading = {panel: {"alpha": alpha} for panel in ("fig07", "fig07_inset")}
claim("closed.spreading_half", spreading, [(1.85, 0.03)])
claim("closed.spreading_zero", spreading, [(1.8, 0.03)])
sigmas = [0.01 * k for k in (-90, -75, -60, -45, -30, -15, 15, 30, 45, 60, 75, 90)]
claim("closed.spreading_with_drift", spreading, [1.8 + 0.1 * sigma for sigma in sigmas])
claim("closed.spreading_without_drift", spreading, [1.4 + 0.1 * sigma for sigma in sigmas])
found = of_runs("fig07_inset", alpha, lambda run: run.series == "random")
claim("closed.random_directions", spreading, found)
drift = {"fig07_inset": {"momentum_change": lambda run: 10 ** (-3 - alpha(run))}}
found = [-4.8 - 0.1 * sigma for sigma in sigmas] + [-4.4 - 0.1 * sigma for sigma in sigmas]
claim("closed.momentum_changes", drift, found)


# Conductivity. At gamma = 1 kappa is N, but smaller by a factor of e^-0.002 at 512, the first of the three
# sizes within a factor of 4 of the largest. The sizes are equally spaced in ln N, so this changes the slope by
# 0.002/2 over the spacing. At gamma = N kappa is sqrt(N) up to 256 and N^0.2 beyond. The runs at N = 32
# are not stationary.
def kappa(run: Run) -> float:
    size = run.options["cells"]
    if size == 32 or (size < 512 and rare(run)):
        return float(1000 * size)
    if rare(run):
        return float(size * math.exp(-0.002 * (size == 512)))
    return float(256**0.5 * (size / 256) ** (0.5 if size < 256 else 0.2)) * (1 + (size < 16))


def still(run: Run) -> float:
    return float(run.options["cells"] != 32)


both = {"kappa": kappa, "stationary": still}
rare_exponent = (1 + 1e-3 / math.log(2), 1e-3 / math.log(2))
claim("growth.linear", {"fig08": both}, [rare_exponent])
claim("growth.cube_root", {"fig08": both}, [0.2])

# The exponent over the last octave of a ring; over octaves before it is smaller. ⟨Q²⟩ has this exponent from
# t = 64 on.
last_octaves = {"light-longest": 1.31, "dense-longest": 1.32, "dilute-longest": 1.34, "sparse-longest": 1.35}


def noise(run: Run, rotation: float) -> float:
    """The exponent with noise: the probability of a reversal; `rotation` where as many collisions are followed
    by a rotation; others."""
    rotated = rotation if run.options.get("rotation-probability") == 0.1 else 0.5
    return float(run.options.get("reversal-probability", rotated))


def octaves(run: Run, middle: np.ndarray) -> np.ndarray:
    other = 1 + noise(run, 0.44)
    return last_octaves.get(run.name, other) - 0.02 * (middle != middle.max())


def passed(run: Run, time: np.ndarray) -> np.ndarray:
    return np.where(time < 64, 9, time ** last_octaves.get(run.name, 2))


rings = {"momentum": {"local_exponent": octaves, "heat_variance": passed}}
claim("growth.superdiffusive", rings, [1.31, 1.32, 1.34, 1.35])


# Where momentum is reversed with the probability ε, κ is N^ε between the sizes 32 and 128, and larger
# elsewhere; with rotations, N^0.42. Reversed chains are not stationary at N = 64, and have a larger
# size than the others.
def disturbed(run: Run) -> float:
    size = run.options["cells"]
    return float(size ** noise(run, 0.42) * (2 if size not in (32, 128) else 1))


def undisturbed(run: Run) -> float:
    return float(run.series != "chain-reversal" or run.options["cells"] != 64)


chains = {"kappa": disturbed, "stationary": undisturbed}
claim("growth.without_momentum", {"momentum": rings["momentum"] | chains}, [0.32, 0.34])


# At the k-th time the peak is at 5.2 + 3k cells and 100 + 10k high; there is none at the first and at the
# last time. The odd part per cell is 0.001 of the height. Speeds fall as t^-0.1; they are NaN at the first
# time and twice as large at the third. Other starts differ.
def place(_run: Run, t: np.ndarray) -> np.ndarray:
    k = np.arange(len(t))
    return np.where((k == 0) | (k == len(t) - 1), np.nan, 5.2 + 3 * k)


def odd(run: Run, t: np.ndarray, x: np.ndarray) -> np.ndarray:
    return 1e-3 * (1 + (run.name == "gaussian")) * x * (100 + 10 * np.arange(len(t))[:, None])


def speeds(run: Run, middle: np.ndarray) -> np.ndarray:
    k = np.arange(len(middle))
    return 300 * middle ** (-0.1 if run.name == "rest" else -1) * np.select([k == 0, k == 2], [np.nan, 2], 1)


leaving = pulse("fig09a", peak=lambda _, t: 100 + 10 * np.arange(len(t)), peak_position=place, odd_part=odd,
                centre_share=lambda _, t: 0.1 + t, peak_speed=speeds)  # fmt: skip
left = [0.2, *(1e-3 * (5 + 3 * k) for k in range(1, 8))]
found = [*(10 * value for value in left), -0.4]
claim("pulse.peaks_leave", leaving, found, peak=EXACT, peak_position=EXACT)


# The peak moves ballistically except at the last time, at which it is e^d times farther. Without that time
# the exponent is 1.
def farther(d: float) -> Callable[..., np.ndarray]:
    return lambda run, t: (
        300 * t ** (3 if (run.name, d) == ("gaussian", 0.02) else 1) * np.where(t == t.max(), math.exp(d), 1)
    )


def ballistic(d: float, first: float, second: float, end: float) -> tuple[float, float]:
    bounds = (d / math.log(end / first), d / math.log(end / second) - d / math.log(end / first))
    return 1 + bounds[0], max(bounds)


peaks = pulse("fig09b", peak_position=farther(0.02))
claim("pulse.ballistic", peaks, [ballistic(0.02, 0.01, 0.0125, 0.025)])
later_peaks = pulse("fig10b", peak_position=farther(0.05))
claim("pulse.ballistic_later", later_peaks, [ballistic(0.05, 0.02, 0.04, 0.16)])


# Damping exponents. Each fit that begins one time later gives an exponent that is 0.01 larger. That of the
# other start differs.
def later(exponent: float) -> Callable[..., np.ndarray]:
    return lambda run, _: exponent + 0.01 * np.arange(len(str(run.options["times"]).split(",")) - 1)


def damped(panel: str, rest: float, **others: Any) -> World:
    def of_start(run: Run) -> float:
        return rest if run.name == "rest" else 9.0

    fits = {
        "damping_exponent": of_start,
        "damping_exponent_from": lambda run, t: later(of_start(run))(run, t),
    }
    return pulse(panel, **fits, **others)


claim("pulse.damping", damped("fig09a", 0.64), [(0.64, 0.04 + 0.02)])
claim("pulse.damping_rare", damped("fig09b", 1.5), [(1.5, 0.02)])

# 2 - 1/xi with xi = 0.66 and 0.9, and the exponents of kappa over the largest sizes; at gamma = N kappa is an
# exact power.
kappa_n = {
    "kappa": lambda run: (
        kappa(run) if rare(run) else run.options["cells"] ** (0.2 if run.options["cells"] > 100 else 3)
    )
}
linked = {**damped("fig09a", 0.66), **damped("fig09b", 0.9), "fig08": both | kappa_n}
found = [
    (2 - 1 / xi - value, fits / xi**2 + bound)
    for xi, fits, (value, bound) in ((0.66, 0.04, (0.2, 0)), (0.9, 0.02, rare_exponent))
]
claim("pulse.relation_of_moving_peaks", linked, found)

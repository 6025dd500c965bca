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
sigmas = [0.01 * k for k in (99, 95, 90, 80, 70, 60, 50, 40, 30, 20, 10)]
sigmas = [*(-sigma for sigma in sigmas), *sigmas[::-1]]
claim("closed.correlated", persistences, [abs(np.arccos(x) / np.pi + 0.01 * (2 + x) - 0.5) for x in sigmas])

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


spreading = {"fig07_inset": {"alpha": alpha}}
slopes = {"local_slope": lambda run, t: t / 1000 + (run.name != "all")}
late = np.geomspace(1, 1000, 10)[-3:]  # in the last decade
claim("closed.spreading_half", {"fig07": slopes}, late / 1000)
claim("closed.spreading_zero", spreading, [1.8, 1.77])
sigmas = [0.01 * k for k in (-90, -75, -60, -45, -30, -15, 15, 30, 45, 60, 75, 90)]
claim("closed.spreading_with_drift", spreading, [1.8 + 0.1 * sigma for sigma in sigmas])
claim("closed.spreading_without_drift", spreading, [1.4 + 0.1 * sigma for sigma in sigmas])
found = of_runs("fig07_inset", alpha, lambda run: run.series == "random")
claim("closed.random_directions", spreading, found)
drift = {"fig07_inset": {"momentum_change": lambda run: 10 ** (-3 - alpha(run))}}
found = [-4.8 - 0.1 * sigma for sigma in sigmas] + [-4.4 - 0.1 * sigma for sigma in sigmas]
claim("closed.momentum_changes", drift, found)


# Conductivity. From N = 32 to 2N at gamma = 1 it grows as the power 1, at gamma = N as 1/2, and from there on by 0.01
# more from octave to octave. The runs at N = 256 are not stationary; from one octave to the next nothing is known
# there.
def kappa(run: Run) -> float:
    octave = math.log2(run.options["cells"] / 32)
    return float(2 ** (octave * (1 if rare(run) else 0.5) + 0.005 * octave * (octave - 1))) * (
        1000 if run.options["cells"] == 256 else 1
    )


def still(run: Run) -> float:
    return float(run.options["cells"] != 256)


def by_octave(power: float) -> list[float]:
    """The octaves from 128 and the one from 256, across which a size is missing, are one that is unknown."""
    return [power, power + 0.01, math.nan, power + 0.04, power + 0.05]


both = {"kappa": kappa, "stationary": still}
claim("growth.linear", {"fig08": both}, by_octave(1))
claim("growth.cube_root", {"fig08": both}, by_octave(0.5))

# The exponent over the last octave of a ring; over octaves before it is smaller.
last_octaves = {"light-longest": 1.31, "dense-longest": 1.32, "dilute-longest": 1.34, "sparse-longest": 1.35}


def noise(run: Run, rotation: float) -> float:
    """The exponent with noise: the probability of a reversal; `rotation` where as many collisions are followed
    by a rotation; others."""
    rotated = rotation if run.options.get("rotation-probability") == 0.1 else 0.5
    return float(run.options.get("reversal-probability", rotated))


def octaves(run: Run, middle: np.ndarray) -> np.ndarray:
    other = 1 + noise(run, 0.44)
    return last_octaves.get(run.name, other) - 0.02 * (middle != middle.max())


rings = {"momentum": {"local_exponent": octaves}}
claim("growth.superdiffusive", rings, [*last_octaves.values()])


# Where momentum is reversed with the probability ε, κ is N^ε, with rotations N^0.42, from N = 128 on a power that is 0.1
# larger. Reversed chains are not stationary at N = 64, where those with rotations differ.
def disturbed(run: Run) -> float:
    size, power = run.options["cells"], noise(run, 0.42)
    rotated = run.series == "chain-rotation"
    return float(size**power * max(1, size / 128) ** (0.1 * rotated) * (2 if size == 64 else 1))


def undisturbed(run: Run) -> float:
    return float(run.series != "chain-reversal" or run.options["cells"] != 64)


chains = {"kappa": disturbed, "stationary": undisturbed}
claim("growth.without_momentum", {"momentum": rings["momentum"] | chains}, [0.34, math.nan, 0.42])


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


# The peak at the first time is A exp(-s²/18 + b s³) in cells, s = y - 7, whose maximum in free flight attenuated by
# exp(-y (f - 1)/N) is at s = -c of (f - 1)/N = c/9 + 3 b c², c = 0.12. The position grows as t^0.9.
LOST = 1.5 / 101
BEND = (LOST - 0.12 / 9) / (3 * 0.12**2)


def moving(run: Run, t: np.ndarray) -> np.ndarray:
    return 7 * (t / t.min()) ** (0.9 if run.name == "rest" else 3)


peaks = pulse("fig09b", peak_position=moving, peak_quadratic=-1 / 18, peak_cubic=BEND)
attenuated = 1 + math.log(1 - 0.12 / 7) / math.log(2.5)
claim("pulse.ballistic", peaks, [0.9 - attenuated])
accelerated = lambda _, t: 300 * np.exp(0.1 * np.log(t / 0.02) ** 2) * t  # noqa: E731
steps = [1 + 0.1 * (2 * k + 1) * math.log(2) for k in range(3)]
claim("pulse.ballistic_later", pulse("fig10b", peak_position=accelerated), steps)


# Damping exponents: octaves have their number, fits 0.01 more for each time by which they begin later. Those of the
# other start differ.
def damped(panel: str, rest: float) -> World:
    def of_start(run: Run) -> float:
        return rest if run.name == "rest" else 9.0

    fits = {
        "damping_exponent": of_start,
        "damping_exponent_from": lambda run, t: of_start(run) + 0.01 * np.arange(len(t)),
        "local_damping_exponent": lambda run, t: of_start(run) + np.arange(len(t)),
    }
    return pulse(panel, **fits)


claim("pulse.damping", damped("fig09a", 0.64), [(0.64 + k, 0.02) for k in range(4)])
claim("pulse.damping_fits", damped("fig09a", 0.64), [0.64 + 0.03, 0.64 + 0.04])
claim("pulse.damping_rare", damped("fig09b", 1.5), [1.5, 2.5])

# 2 - 1/xi with xi = 0.9, and the exponent of kappa from N = 32 on.
linked = {
    **damped("fig09b", 0.9),
    "fig08": {
        "kappa": lambda run: run.options["cells"] ** (1.1 if rare(run) and run.options["cells"] >= 32 else 3),
        "stationary": 1,
    },
}
claim("pulse.relation_of_moving_peaks", linked, [2 - 1 / 0.9 - 1.1])

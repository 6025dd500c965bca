"""Exact results for one function of every module of claims, called worlds, with the numbers that it must take
from them. All claims are compared with the numbers of the release, in test_claims_of_release.py.

Runs, elements and quantities that could be confused have different values, so that a number from a wrong
one is noticed."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from tests.python.conftest import sampled
from tests.study.known_results import World
from workflow.pipeline.plan import Run

COLD, HOT = 900 / 11, 1100 / 9  # temperatures of the baths
# Expected numbers of a claim: values, or pairs of value and systematic error. Without a pair the systematic
# error is 0.
Answer = Sequence[float | tuple[float, float]]
CASES: dict[str, tuple[World, Answer]] = {}


def rare(run: Run) -> bool:
    """Whether the run has gamma = 1, where scattering is rare."""
    return bool(run.options["gamma"] == 1)


def claim(function: str, world: World, numbers: Answer) -> None:
    CASES[function] = world, numbers


def named(values: Mapping[str, Any]) -> Callable[..., Any]:
    """Truth of a quantity that is looked up by the name of the run."""
    return lambda run, *_: values[run.name]


# Filling chains. levels: heights of the plateau at the times 200, 600, 1000, 1400 and 1800.
levels = 10 * np.cumprod([1, 1.1, 1.2, 1.3, 1.4])
plateau = {"plateau": lambda run, t: levels if run.name == "unit-chain" else t}
claim("filling.stationary_above_front", {"fig01": plateau}, [0.1, 0.2, 0.3, 0.4])
slopes = {"log_slope": named({"unit-chain": 1.3 * levels[-1], "unit-spacing": 1})}
claim("filling.grows_logarithmically", {"fig01": plateau | slopes}, [0.3])

claim(
    "profiles.density_profiles",
    {"fig02_upper": {"density_slope": named({"deterministic": -0.4, "rare": -0.1}),
                     "density_excess": named({"deterministic": [0.1, 0.2], "rare": [0.4, 0.9]})}},
    [0.75, 0.3, 0.7],
)  # fmt: skip


def curved(run: Run, place: np.ndarray, p: np.ndarray) -> np.ndarray:
    """F with a curvature at p > 0. At p = 0 the line through the bins at 0.6 and 1.8 is wrong by 3 x 0.6^2
    times the coefficient of p^2."""
    return np.where(p > 0, 10 + 0.05 * p**2, 8 + 0.1 * p) * (
        run.name in ("equal", "mean-field-equal")
    ) + 12 * (abs(p) > 50)


largest = 10 + 0.05 * 59.4**2 + 12
claim(
    "fluxes.jump_from_rates_only",
    {"fig04b": {"flux": curved, "jump": lambda run, place: np.where(sampled(run), 1 + 0.1 * place, 2.0)}},
    [(1.1 / largest, 3 * 0.36 * 0.05 / largest), (4 / largest, 3 * 0.36 * 0.05 / largest)],
)  # fmt: skip


# Persistence: the law plus a shift that depends on sigma and is twice as large in the dense chain, which must
# not count.
def shift(run: Run) -> float:
    return float((0.02 if run.series == "dense" else 0.01) * (2 + run.options["sigma"]))


persistences = {"fig05": {"mu": lambda run: np.arccos(run.options["sigma"]) / np.pi + shift(run)}}
claim("closed.persistence_limits", persistences, [0.01, 0.02, 0.03])


# Conductivity. From N = 32 to 2N at gamma = 1 it grows as the power 1, at gamma = N as 1/2, and from there on
# by 0.01 more from octave to octave. The runs at N = 256 are not stationary; from one octave to the next
# nothing is known there.
def kappa(run: Run) -> float:
    octave = math.log2(run.options["cells"] / 32)
    return float(2 ** (octave * (1 if rare(run) else 0.5) + 0.005 * octave * (octave - 1))) * (
        1000 if run.options["cells"] == 256 else 1
    )


def still(run: Run) -> float:
    return float(run.options["cells"] != 256)


# The octaves from 128 and the one from 256, across which a size is missing, are one that is unknown.
by_octave = [1, 1.01, math.nan, 1.04, 1.05]
claim("growth.linear", {"fig08": {"kappa": kappa, "stationary": still}}, by_octave)


# The exponent over the last octave of a ring; over octaves before it is smaller. Shorter rings of a gas
# differ.
last_octaves = {"light-longest": 1.31, "dense-longest": 1.32, "sparse-longest": 1.35, "thin-longest": 1.2}
last_octaves |= {"light-rotation": 1.44, "light-reversal": 1.1, "thin-rotation": 1.3, "thin-reversal": 1.05}
last_octaves |= {"gas-16": 1.44, "gas-32": 1.43, "gas-64": 1.36, "gas-128": 1.26}
last_octaves |= {"gas-256": 1.18, "gas-512": 1.13, "gas-1024": 1.06, "gas-2048": 1.01}


def octaves(run: Run, middle: np.ndarray) -> np.ndarray:
    return last_octaves.get(run.name, 1.6) - 0.02 * (middle != middle.max())


rings = {"momentum": {"local_exponent": octaves, "mean_square_heat": 1}}
claim("growth.superdiffusive", rings, [1.44, 1.43, 1.36, 1.26, 1.18, 1.13, 1.06, 1.01])
claim("growth.superdiffusive_at_fixed_density", rings, [1.31, 1.32, 1.35, 1.2])
claim("growth.without_momentum", rings, [0.34, 0.25])


# Damping exponents of a pulse in a ring that has not closed: octaves have their number, fits 0.01 more for
# each time by which they begin later. Those of the other start differ.
def rest(run: Run) -> float:
    return 0.64 if run.name == "rest" else 9.0


damped = {
    "damping_exponent": rest,
    "damping_exponent_from": lambda run, t: rest(run) + 0.01 * np.arange(len(t)),
    "local_damping_exponent": lambda run, t: rest(run) + np.arange(len(t)),
    "peak": 1,
    "peak_position": 10,
    "energy_difference": lambda _run, _t, x: (x > 1) & (x < x.max() - 1),
}
# Octaves from t = 0.04 and from 0.063 on. Those before begin before 0.032.
biases = [0.013 / math.log(ratio) for ratio in (0.063 / 0.04, 0.1 / 0.063)]
claim("pulse.damping", {"fig09a": damped}, [*zip((2.64, 3.64), biases, strict=True)])
# The peak moves from 10 cells to 16 and to 25, and is lower by 1/(3 x²).
damped |= {"peak_position": lambda _, t: 1000 * t}
biases = [(a**-2 - b**-2) / 3 / math.log(b / a) for a, b in ((10, 16), (16, 25))]
claim("pulse.damping_rare", {"fig09b": damped}, [*zip((0.64, 1.64), biases, strict=True)])

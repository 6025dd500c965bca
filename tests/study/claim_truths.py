"""Exact results for the function of every claim, called worlds, with the numbers that it must take from them.

Runs, elements and quantities that could be confused have different values, so that a number from a wrong
one is noticed."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.python.conftest import sampled
from tests.study.known_results import Truth
from workflow.pipeline.plan import Run

COLD, HOT = 900 / 11, 1100 / 9  # temperatures of the baths
# Exact results: by panel, the true values of the quantities on which the function depends.
World = Mapping[str, Truth]

# Expected numbers of a claim: values, or pairs of value and systematic error. Without a pair the systematic
# error is 0.
Answer = Sequence[float | tuple[float, float]]
EXACT = 1e-9  # relative standard error of denominators, whose errors the claims neglect


@dataclass(frozen=True)
class Case:
    """A world with the numbers that a function must find. errors: relative standard errors by quantity;
    "*": all others."""

    world: World
    numbers: Answer
    errors: Mapping[str, float] = field(default_factory=dict)
    quality: str = "paper"


def rare(run: Run) -> bool:
    """Whether the run has gamma = 1, where scattering is rare."""
    return bool(run.options["gamma"] == 1)


def gaussian(temperature: float, factor: float) -> Any:
    """Gaussian momentum distribution of a temperature, whose integral is `factor`."""
    return lambda _run, _place, p: factor * np.exp(-(p**2) / 2 / temperature) / np.sqrt(2 * np.pi * temperature)  # fmt: skip


CASES: dict[str, Case] = {}
ERROR = 1e-3  # relative standard error of quantities without one of their own


def claim(function: str, world: World, numbers: Answer, quality: str = "paper", **errors: float) -> None:
    CASES[function] = Case(world, numbers, {"*": ERROR} | errors, quality)


def named(values: Mapping[str, Any]) -> Callable[..., Any]:
    """Truth of a quantity that is looked up by the name of the run."""
    return lambda run, *_: values[run.name]


# Filling chains. levels: heights of the plateau at the times 200, 600, 1000, 1400 and 1800.
levels = 10 * np.cumprod([1, 1.1, 1.2, 1.3, 1.4])
plateau = {"plateau": lambda run, t: levels if run.name == "unit-chain" else t}
claim("filling.stationary_above_front", {"fig01": plateau}, [0.1, 0.2, 0.3, 0.4])
fronts = {"fig01": {"front_exponent": named({"unit-chain": -0.15, "unit-spacing": -0.2})}}
claim("filling.grows_logarithmically", fronts, [-0.85])
claim("filling.front_falls", fronts, [-0.15])

# Profiles of 30 cells.
profile = {
    "deterministic": [COLD + 0.1 * (HOT - COLD), *[100] * 28, HOT - 0.2 * (HOT - COLD)],
    "rare": [COLD + 0.3 * (HOT - COLD), *[110] * 28, HOT - 0.35 * (HOT - COLD)],
}
claim(
    "profiles.temperatures_mismatch",
    {"fig02_upper": {"temperature_scatterer": named(profile)}},
    [0.1, 0.2, 0.3, 0.35, 0.35],
)

cells = np.arange(30.0)
local = {"deterministic": 80 + cells, "rare": 120 + cells}
mismatch = {"deterministic": 0.001 * (1 + cells), "rare": 0.002 * (1 + cells)}
difference = {name: local[name] * mismatch[name] for name in local}
found = [*mismatch["deterministic"], *mismatch["rare"]]
claim(
    "profiles.temperatures_coincide",
    {"fig02_upper": {"temperature_particle": named(local), "temperature_difference": named(difference)}}, found, temperature_particle=EXACT,
)  # fmt: skip

claim(
    "profiles.density_profiles",
    {"fig02_upper": {"density_slope": named({"deterministic": -0.4, "rare": -0.1}),
                     "density_excess": named({"deterministic": [0.1, 0.2], "rare": [0.4, 0.9]})}},
    [0.75, 0.3, 0.7],
)  # fmt: skip


def deviation(size: float) -> Callable[..., np.ndarray]:
    return lambda run, place: size * (1 + place) * (2 if rare(run) else 1)


found = [
    factor * size * (1 + k) / 200
    for factor in (1, 2)
    for size, numbers in ((1, range(1, 29)), (5, range(1, 29)), (7, range(31)))
    for k in numbers
]
claim(
    "profiles.linear_rates",
    {"fig02_upper": {"rate_right": lambda _, cell: 200 + (cell - 14.5), "rate_right_deviation": deviation(1),
                     "rate_left_deviation": deviation(5), "particle_current_deviation": deviation(7)}},
    found, rate_right=EXACT,
)  # fmt: skip


# Equilibrium at T = 100, with deviations from it that are twice as large at gamma = 1.
def times(run: Run) -> int:
    return 2 if rare(run) else 1


def side(p: np.ndarray) -> np.ndarray:
    return np.where(p > 0, -1, 1)


claim(
    "fluxes.equilibrium",
    {"fig04b": {
        "square": lambda run, bond, half: 100 * (1 + 0.01 * times(run) * half * (1 + bond / 30)),
        "kurtosis": lambda run, bond, half: 3 * (1 + 0.03 * times(run) * half * (1 + bond / 30)),
        "temperature_scatterer": lambda run, cell: 100 * (1 + times(run) * np.select([cell == 0, cell == 29], [0.05, 0.07], 9)),
        "flux": lambda run, bond, p: gaussian(100, 400)(run, bond, p) * (1 + 0.04 * times(run) * side(p))
            * np.select([(bond == 0) & (p < 0), (bond == 30) & (p > 0)], [1, 1], 7),
        "scatterer_density": lambda run, end, p: gaussian(100, 1)(run, end, p) * (1 + times(run) * np.where(end == 0, 0.02, 0.04) * side(p)),
    }},
    [value for factor in (2, 1) for value in (-0.01 * factor, -0.03 * factor, 0.05 * factor, 0.02 * factor,
                                              0.06 * factor, 0.07 * factor, 0.02 * factor, 0.015 * factor)],
)  # fmt: skip

# Solutions of the kinetic equation have a discretisation error, here ERROR relative to the value, and no
# standard error.
halves = {"kurtosis": lambda run, _, half: 3 + (0.1 if run.name == "paper" else 9) * half * (1 + (half > 0))}
departures = [(d, ERROR * (3 + s * d)) for d, s in ((0.1, -1), (0.2, 1))]
kinetic = {
    **halves,
    "jump": lambda _, x: 0.4 + 0.5 * x,
    "flux_density": lambda _, x, p: 5 + 5 * (abs(p) < 10) * (1 - x),
}
claim("fluxes.jump_and_halves", {"fig03": kinetic}, [(0.04, 0.04 * ERROR), (0.09, 0.09 * ERROR), *departures])


def of_outgoing(run: Run, bond: np.ndarray, half: np.ndarray) -> np.ndarray:
    outgoing = np.select([(bond == 0) & (half < 0), (bond == 30) & (half > 0)], [-0.1, 0.3], 7)
    return 3 + np.where(run.name == "deterministic", outgoing, 5)


claim("fluxes.not_gaussian", {"fig04b": {"kurtosis": of_outgoing}}, [0.1, 0.3])

# F_N - F of the shortest mean field falls from 2 and 3 at p = 0; that of simulations is 2.2/N of it. F is linear in p on
# either side of p = 0, so that the wide bins of the simulations have its value in their middle.
P = np.arange(-59, 60, 2)
SEEN = abs(P) < 40
HEIGHT = 20  # largest value of F


def shape(p: np.ndarray) -> np.ndarray:
    return np.where(p < 0, 2 + 0.01 * p, 3 - 0.02 * p)


def finite(run: Run, place: np.ndarray, p: np.ndarray) -> np.ndarray:
    size, exact = run.options["cells"], HEIGHT - 0.05 * abs(p) + 0 * place
    if size == "continuum":
        return exact
    outgoing = np.where(place == 0, p < 0, (p > 0) & (place == place.max()))
    height = 2.2 / size if sampled(run) else {2: 1, 4: 7}.get(size, 5)
    return exact + np.where(outgoing, height * shape(p), 9)


bounds = {
    2: 1e-3,
    4: 1e-3,
    8: 1e-3,
    16: 1e-4,
}  # F integrates to 220 + 180; its largest value is in a bin of 0.2
found = [3 * 2.2 / size / 400 / bound for size, bound in bounds.items()]
claim("fluxes.deviations_over_bounds", {"fig03_inset": {"flux": finite}}, found)


def at_centre(run: Run, place: np.ndarray, p: np.ndarray) -> np.ndarray:
    """F_N whose deviation at N = 2 is -0.4 and -0.6 in the innermost bins and 0.5 (1 + p/1000) beyond.
    Other sizes and halves have the deviation 3, which no number may contain."""
    if run.options["cells"] == "continuum":
        return HEIGHT + 0 * p
    outgoing = np.where(place == 0, p < 0, p > 0) & (run.options["cells"] == 2)
    part = np.select([p == -1, p == 1], [-0.4, -0.6], 0.5 * (1 + 1e-3 * p))
    return HEIGHT + np.where(outgoing & sampled(run), part, 3)


outer = P[(abs(P) > math.sqrt(0.5 * (COLD + HOT))) & SEEN]
claim("fluxes.deviations_central", {"fig03_inset": {"flux": at_centre}}, [*(-1e-3 * outer), 0.1 / HEIGHT])


def falling(run: Run, place: np.ndarray, p: np.ndarray) -> np.ndarray:
    """F_N whose deviation in the innermost outgoing bins is -0.8 and 1.2 times N^-0.9."""
    if run.options["cells"] == "continuum":
        return HEIGHT + 0 * p
    outgoing = np.where(place == 0, p < 0, p > 0)
    part = np.select([p == -1, p == 1], [-0.8, 1.2], 7) * run.options["cells"] ** (
        -0.9 if sampled(run) else 3
    )
    return HEIGHT + np.where(outgoing, part, 3)


claim("fluxes.tends_to_kinetic", {"fig03_inset": {"flux": falling}}, [-0.9])


# F_30 minus the solution of the kinetic equation: it differs from bin to bin and between the ends.
def bumps(place: float, p: np.ndarray) -> np.ndarray:
    return 0.5 * np.sin(p / 7) + 1.5 * (place == 1) + 4


def flux(run: Run, place: np.ndarray, p: np.ndarray) -> np.ndarray:
    x = place / (30 if sampled(run) else 1)
    theory = 30 * np.exp(-((p - 5 * np.round(x, 9)) ** 2) / 400)
    near = np.isclose(x, 1 / 30)
    return theory + sampled(run) * np.where(near | (x == 1), np.where(x == 1, bumps(1, p), bumps(0, p)), 50)


q = np.arange(-59.4, 60, 1.2)
q = q[abs(q) < 40]


def largest_of(places: Sequence[float]) -> float:
    grid = np.arange(-59.4, 60, 1.2)
    return float(max(np.max(30 * np.exp(-((grid - 5 * x) ** 2) / 400)) for x in places))


found = [*bumps(0, q), *bumps(1, q)]
claim("fluxes.on_top_of_kinetic", {"fig04a": {"flux": flux}}, np.array(found) / largest_of([1 / 30, 1]))


claim(
    "fluxes.jump_smaller",
    {"fig04a": {"jump": lambda _, bond: 4 + bond}, "fig04b": {"jump": lambda run, bond: np.where(run.name == "deterministic", 1 + 0.5 * bond, 99)}},
    [1.5 / 5, 16 / 34],
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
    [(1.1 / largest, 3 * 0.36 * 0.05 / largest), (4 / largest, 3 * 0.36 * 0.05 / largest)], flux=EXACT,
)  # fmt: skip

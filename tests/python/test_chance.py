"""Closed chains against the reference simulator, which shares no code and no random numbers with the
programs.

That no two replicas or seeds share a draw is tested in tests/cpp/engine/chance_test.cpp. Draws common to all
of them shift every result alike, and only this comparison finds them.
"""

from dataclasses import asdict, dataclass, replace
from functools import cache

import numpy as np
import pytest

from tests.python.conftest import Measure, agree, simulate


@dataclass(frozen=True)
class Chain:
    """Few particles in many replicas, so that errors common to all replicas exceed the standard errors."""

    sigma: float = 0.5
    gamma: float | str = "N"
    rule: str = "elastic"
    reversal_probability: float | None = None
    rotation_probability: float | None = None
    cells: int = 6
    particles_per_cell: int = 1
    temperature: float = 500
    relaxation_time: float = 0.5
    observation_time: float = 5
    replicas: int = 4000

    @property
    def options(self) -> dict[str, object]:
        """The chain as options of a program."""
        return {name: value for name, value in asdict(self).items() if value is not None}

    def __str__(self) -> str:
        return f"sigma={self.sigma},gamma={self.gamma},{self.rule},cells={self.cells}"


DECADES, POINTS_PER_DECADE, EVERY = 2, 8, 4  # times of the programs; every fourth is compared
BINS_PER_DECADE, BINS = 10, 50  # bins of the waiting times
MEANS = ("mu", "particle_energy", "scatterer_energy")  # over scatterings


def waiting_time_edges(chain: Chain) -> np.ndarray:
    return 1e-3 / np.sqrt(chain.temperature) * 10 ** (np.arange(BINS + 1) / BINS_PER_DECADE)


@cache
def reference(chain: Chain) -> dict[str, np.ndarray]:
    """Measurements of the reference simulator, [replica, ...]."""
    gamma = chain.cells if chain.gamma == "N" else chain.gamma
    times = chain.observation_time * 10 ** np.arange(-DECADES, 0.01, EVERY / POINTS_PER_DECADE)
    options = asdict(chain) | {"gamma": gamma, "times": ",".join(map(str, times)), "seed": 1}
    names = ("particle_reversal", "scatterer_reversal", "rotation")
    reversal, rotation = (options.pop(f"{name}_probability") for name in ("reversal", "rotation"))
    noise = {"random-direction": (0.5, 0, 0), "reversal": (0, reversal, 0), "rotation": (0, 0, rotation)}
    options |= dict(zip(names, noise.get(options.pop("rule"), (0, 0, 0)), strict=True))
    bins = {"first_edge": waiting_time_edges(chain)[0], "bins_per_decade": BINS_PER_DECADE, "bins": BINS}
    rows = simulate("closed_chain", **options, **bins)
    moments, scatterings, sums, waits = np.split(rows, 2 * len(times) + np.array([0, 1, 4]), axis=1)
    names = ("mean_square_displacement", "mean_square_drift")
    measurements = dict(zip(names, np.moveaxis(moments.reshape(chain.replicas, -1, 2), 2, 0), strict=True))
    means = dict(zip(MEANS, np.moveaxis(sums[:, :, None], 1, 0), strict=True))
    return measurements | means | {"scatterings": scatterings, "waits": waits}


def average(sample: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return sample.mean(axis=0), sample.std(axis=0, ddof=1) / np.sqrt(len(sample))


def ratio(counts: np.ndarray, totals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ratio of sums over replicas, with its standard error to first order."""
    value = counts.sum(axis=0) / totals.sum()
    return value, average((counts - value * totals) / totals.mean())[1]


Measured = dict[str, tuple[np.ndarray, np.ndarray]]  # means and standard errors


def measured(measure: Measure, chain: Chain) -> Measured:
    """Means and standard errors of all measurements by the programs."""
    measurements: Measured = {}

    def add(name: str, quantities: list[str], every: int = 1, **options: object) -> None:
        result = measure(name, **chain.options, **options)
        for key in quantities:
            measurements[key] = tuple(
                np.ravel(x)[::every] for x in (result[key].mean, result[key].standard_error)
            )

    add("displacement", ["mean_square_displacement", "mean_square_drift"], EVERY, decades=DECADES)
    add("persistence", [*MEANS])
    add("waiting_time", ["density"])
    return measurements


def scores(measurements: Measured, chain: Chain) -> dict[str, np.ndarray]:
    """z-scores of all measurements against the reference simulator."""
    sample = reference(chain)
    expected = {name: average(sample[name]) for name in measurements if name not in (*MEANS, "density")}
    often = sample["waits"].sum(axis=0) > 200  # often enough for a normal mean
    expected |= {name: ratio(sample[name], sample["scatterings"]) for name in MEANS}
    widths = np.diff(waiting_time_edges(chain))
    density = ratio(sample["waits"], sample["scatterings"])
    expected["density"] = tuple((x / widths)[often] for x in density)
    measurements = measurements | {"density": tuple(x[:BINS][often] for x in measurements["density"])}
    return {
        name: (measurements[name][0] - mean) / np.hypot(measurements[name][1], error)
        for name, (mean, error) in expected.items()
    }


CHAINS = [
    *(Chain(sigma, gamma) for sigma, gamma in ((0.5, "N"), (-0.4, 3), (-0.4, 0.3))),
    *(Chain(sigma, gamma, "random-direction") for sigma, gamma in ((-0.4, "N"), (0.5, 1))),
    *(Chain(sigma, gamma, "reversal", 0.3) for sigma, gamma in ((0.5, "N"), (-0.4, 1))),
    *(Chain(*gas, "rotation", rotation_probability=0.3) for gas in ((0.5, "N"), (-0.4, 1))),
    Chain(-0.9, "N", "rotation", rotation_probability=1, cells=2, particles_per_cell=3),
]


@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_closed_chain_against_the_reference_simulator(measure: Measure, chain: Chain) -> None:
    z = scores(measured(measure, chain), chain)
    assert agree(*z.values()), z


def test_closed_chain_with_other_parameters_does_not_agree_with_the_reference(measure: Measure) -> None:
    """Detected mistakes: another mass, rate of scattering, temperature, relaxation time or collision rule."""
    chain = Chain(gamma=1)
    measurements = measured(measure, chain)
    assert agree(*scores(measurements, chain).values())
    noise = ({"rule": name, f"{name}_probability": 0.3} for name in ("reversal", "rotation"))
    for mutant in ({"sigma": 0.42}, {"gamma": 1.1}, {"temperature": 450}, {"relaxation_time": 1}, *noise):
        assert not agree(*scores(measurements, replace(chain, **mutant)).values()), mutant

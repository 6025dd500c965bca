"""The numbers that claims are judged by, from results in which no two values are alike, as in test_claim_numbers.py:
profiles and momentum distributions of open chains."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from tests.python.known_results import (
    DATA,
    Known,
    check,
    each,
    line,
    of,
    power,
    quantity,
    relative_change,
    uneven,
)
from workflow.claims.judge import FUNCTIONS
from workflow.lib.fit import with_error
from workflow.lib.load import Quantity
from workflow.lib.plan import Run

RUNS = ("deterministic", "rare")  # of fig02_upper
COLD, HOT = 900 / 11, 1100 / 9  # the baths
# Of what leaves: to the left at the left end, to the right at the right one.
PLACES = (np.array([0, -1]), np.array([0, 1]))


def test_temperatures() -> None:
    found = [of("fig02_upper", run, "temperature_scatterer") for run in RUNS]
    ends = np.array([mean[[0, -1]] for mean, _ in found]), np.array([error[[0, -1]] for _, error in found])
    mismatch = np.stack([ends[0][:, 0] - COLD, HOT - ends[0][:, 1]], axis=1) / (HOT - COLD)
    steepness = (ends[0][:, 1] - ends[0][:, 0]) / (HOT - COLD)
    errors = ends[1] / (HOT - COLD)
    evidence = FUNCTIONS["C05"](DATA)
    check(
        evidence.literal,
        [*mismatch.ravel(), steepness[0] - steepness[1]],
        [*errors.ravel(), math.sqrt(np.sum(errors**2))],
    )
    assert [one.freedom for one in evidence.literal] == [191, 191, 511, 511, 191]

    local = np.concatenate([of("fig02_upper", run, "temperature_particle")[0] for run in RUNS])
    value, error = np.hstack([of("fig02_upper", run, "temperature_difference") for run in RUNS])
    evidence = FUNCTIONS["C06"](DATA)
    for numbers in (evidence.literal, evidence.intended):
        check(numbers, value / local, error / local)


def test_densities() -> None:
    (steep, less), (steep_error, less_error) = each("fig02_upper", "density_slope", *RUNS)
    value, error = relative_change(steep, less, steep_error, less_error)
    excess = [of("fig02_upper", run, "density_excess") for run in RUNS]
    more, more_error = excess[1][0] - excess[0][0], np.hypot(excess[0][1], excess[1][1])
    check(FUNCTIONS["C07"](DATA).literal, [-value, *more], [error, *more_error], freedom=191)

    runs = [run.name for run in DATA.plan["ext05"].runs if run.options["cells"] >= 20]
    points = [of("ext05", run, "density_excess") for run in runs]
    points.insert(1, of("fig02_upper", "rare", "density_excess"))
    size = np.log([20, 30, 50, 100, 200, 500, 1000])
    for end, found in enumerate(FUNCTIONS["C34"](DATA).literal):
        value, error = np.array([(mean[end], spread[end]) for mean, spread in points]).T
        slope, spread = line(size, value, error)
        check([found], slope, spread, abs(line(size[1:], value[1:], error[1:])[0] - slope), 383)


@pytest.mark.parametrize("smallest", [-0.01, 0.01])
def test_the_smallest_chain_bounds_the_growth_at_the_ends(smallest: float) -> None:
    """Whether it is above or below the line of the others."""

    def fill(run: Run) -> dict[str, Quantity]:
        size = run.options["cells"]
        excess = np.full(2, math.log(size) + smallest * (size == 20))
        return {"density_excess": quantity(run, "density_excess", excess, np.full(2, 0.01))}

    for found in FUNCTIONS["C34"](Known({"ext05": fill, "fig02_upper": fill})).literal:
        assert found.systematic == pytest.approx(abs(found.value - 1))
        assert (found.value < 1) == (smallest > 0)


def test_rates() -> None:
    names = [f"{name}_deviation" for name in ("rate_right", "rate_left", "particle_current")]
    value, error = np.hstack([
        np.hstack([of("fig02_upper", run, name) for name in names]) / of("fig02_upper", run, "rate_right")[0].mean()
        for run in RUNS
    ])  # fmt: skip
    evidence = FUNCTIONS["C08"](DATA)
    for numbers in (evidence.literal, evidence.intended):
        check(numbers, value, error)


def test_equilibrium() -> None:
    """A part of the Gaussians is moved from right to left, of the scatterers unlike at the two ends: the largest distance is where the
    sign changes."""
    bins = np.linspace(-60, 60, 101)
    share, side = np.diff(norm.cdf(bins / 10)), np.where(bins[1:] > 0, -1, 1)

    def fill(run: Run) -> dict[str, Quantity]:
        found = uneven(run)
        if run.program == "momentum_flux":
            flux = 400 * share / 1.2 * (1 + 0.04 * side)
            found["flux"].mean[0, :50], found["flux"].mean[-1, 50:] = np.split(flux, 2)
        else:
            found["scatterer_density"].mean[:] = share / 1.2 * (1 + 0.03 * side) + [[0.01], [-0.01]] * side
        return found

    data = Known({"ext10": fill})
    numbers = iter(FUNCTIONS["C04"](data).literal)
    for gamma in ("1", "N"):
        flux, profile = f"flux_gamma={gamma}", f"profile_gamma={gamma}"
        for place, half in zip(*PLACES, strict=True):
            for name, unit in (("square", 100), ("kurtosis", 3)):
                value, error = (array[place, half] / unit for array in of("ext10", flux, name, data))
                check([next(numbers)], value - 1, error, freedom=255)
            value, error = (
                array[place] / 100 for array in of("ext10", profile, "temperature_scatterer", data)
            )
            check([next(numbers)], value - 1, error, freedom=255)
        total = share.sum() / 1.2
        _, error = of("ext10", flux, "flux", data)
        check([next(numbers)], 0.02, np.linalg.norm(error[0, :50]) / 400 / total, freedom=255)
        _, error = of("ext10", profile, "scatterer_density", data)
        check([next(numbers)], 0.015, np.linalg.norm(error[:, :50]) / 2 / total, freedom=255)
    assert not [*numbers]


def test_kinetic_halves() -> None:
    """Computed numbers have a bound instead of an error."""

    def halves(run: str) -> tuple[np.ndarray, np.ndarray]:
        found = DATA.one("fig03", run)["kurtosis"]
        assert found.discretisation_error is not None
        return abs(found.mean[PLACES] - 3), found.discretisation_error[PLACES]

    result = DATA.one("fig03", "paper")
    jump, largest = result["jump"], result["flux_density"].mean.max()
    assert jump.discretisation_error is not None
    value, bound = np.hstack(
        [np.array([jump.mean, jump.discretisation_error])[:, [0, -1]] / largest, halves("paper")]
    )
    check(FUNCTIONS["C09"](DATA).literal, value, 0, bound, math.inf)
    evidence = FUNCTIONS["C33"](DATA)
    value, bound = np.hstack([halves("paper"), halves("exchange")])
    check(evidence.literal, value, 0, bound)
    check(evidence.intended, halves("paper")[0], 0, halves("paper")[1])
    check(evidence.alternative, halves("equal")[0], 0, halves("equal")[1])


def deviations(run: str) -> tuple[np.ndarray, np.ndarray]:
    """Deviation of the outgoing flux from the continuum, with errors if simulated."""
    exact, found = DATA.one("fig03_inset", "continuum")["flux"].mean, DATA.one("fig03_inset", run)["flux"]
    error = found.mean if found.standard_error is None else found.standard_error
    outer = [np.concatenate([array[0, :30], array[-1, 30:]]) for array in (found.mean, exact, error)]
    return outer[0] - outer[1], outer[2]


SEEN, MOMENTUM = slice(10, 50), np.arange(-59, 60, 2)  # -39 to 39


def multiple(size: int) -> tuple[float, float, np.ndarray]:
    """Ratio of the deviation to that in mean field, by a line through the origin, and the deviation in mean field."""
    value, error = (one[SEEN] for one in deviations(f"simulation_cells={size}"))
    theory = deviations(f"mean-field_cells={size}")[0]
    return *line_through_0(theory[SEEN], value, error), theory


def line_through_0(x: np.ndarray, y: np.ndarray, error: np.ndarray) -> tuple[float, float]:
    (slope,), *_ = np.linalg.lstsq((x / error)[:, None], y / error)
    return float(slope), float(1 / np.linalg.norm(x / error))


def test_deviations_of_finite_chains() -> None:
    """The shape in mean field, as large as in the simulation: in every bin, then at p = 0 from both sides, on lines through the two
    innermost bins, where parabolas through three bound the systematic error. Mutants: the mean field's own size; no error of it."""
    largest = DATA.one("fig03_inset", "continuum")["flux"].mean.max()
    for claim, sizes in (("C10", (2, 4, 8, 16)), ("C11", (16,))):
        expected = []
        for size in sizes:
            factor, spread, theory = multiple(size)
            ends = []
            for inner in ([29, 28, 27], [30, 31, 32]):
                at_0 = [
                    np.polyval(np.polyfit(MOMENTUM[inner[:n]], theory[inner[:n]], n - 1), 0) for n in (2, 3)
                ]
                ends.append((at_0[0], abs(at_0[1] - at_0[0])))
            for value, bound in [*((one, 0) for one in theory[SEEN]), *ends]:
                expected.append(
                    (factor * value / 400, spread * abs(value) / 400, abs(factor) * bound / 400)
                )  # 220 + 180
        evidence = FUNCTIONS[claim](DATA)
        for numbers in (evidence.literal, evidence.intended):
            check(numbers, *np.array(expected).T, 639)
        parts = [np.array(deviations(f"simulation_cells={size}"))[:, SEEN] for size in sizes]
        value, error = np.hstack(parts) / largest
        check(evidence.alternative, value, error, freedom=639)
        factor, spread, _ = multiple(sizes[0])
        assert (
            f"It is {with_error(factor, spread)} of that in mean field at N = {sizes[0]}," in evidence.caveat
        )


def test_decay_of_the_deviations() -> None:
    """Amplitudes of the shape that N = 2 has without correlations. Another that larger N have there does not count, nor does what
    simulations have beside it, nor inner places."""

    def fill(run: Run) -> dict[str, Quantity]:
        found = uneven(run)["flux"]
        size = run.options["cells"]
        height = {"continuum": 0, 2: 0.5, 4: 0.27, 8: 0.12, 16: 0.06}[size] * (1 if run.replicated else 0.9)
        middle = 5 if run.replicated or size == 2 else -5
        distance = (found.axes["momentum"] - middle) / 10
        shape = np.exp(-(distance**2) / 2)
        seen = height * shape * (1 + 0.3 * distance * run.replicated)  # the two parts are orthogonal
        mean = np.array(np.broadcast_to(10 + seen, found.mean.shape))
        mean[1:-1] = 3
        error = uneven(run)["flux"].mean * 1e-3 * (1 + shape)
        return {"flux": quantity(run, "flux", mean, error)}

    data = Known({"fig03_inset": fill})
    shape = np.exp(-((np.arange(-59, 60, 2) - 5) ** 2) / 200)
    errors = []
    for size in (2, 4, 8, 16):
        _, error = of("fig03_inset", f"simulation_cells={size}", "flux", data)
        outer = np.concatenate([error[0, :30], error[-1, 30:]])
        errors.append(math.sqrt(np.sum((shape * outer) ** 2)) / np.sum(shape**2))
    expected = power([2, 4, 8, 16], [0.5, 0.27, 0.12, 0.06], errors)
    check(FUNCTIONS["C12"](data).literal, *expected, 639)


def test_shape_of_the_deviation() -> None:
    value, error = deviations("simulation_cells=2")
    numbers = FUNCTIONS["C32"](DATA).literal
    centre, centre_error = np.mean(abs(value[29:31])), np.hypot(*error[29:31]) / 2
    momentum = np.arange(-59, 60, 2)
    outer = (abs(momentum) > math.sqrt(0.5 * (COLD + HOT))) & (abs(momentum) < 40)
    check(
        numbers[:-1],
        1 - abs(value[outer]) / centre,
        np.hypot(error[outer], centre_error) / centre,
        freedom=639,
    )
    check(numbers[-1:], abs(value[30] - value[29]) / 2 / centre, centre_error / centre, freedom=639)


def test_flux_and_jumps_within() -> None:
    """At the bond after the first scatterer and at the last."""
    flux, error = of("fig04a", "rare", "flux")
    kinetic = DATA.one("fig04a", "kinetic")["flux"].mean
    seen = slice(17, 83)  # momenta from -39 to 39
    value = (flux[[1, -1], seen] - kinetic[:, seen]) / kinetic.max()
    check(
        FUNCTIONS["C13"](DATA).literal,
        value.ravel(),
        error[[1, -1], seen].ravel() / kinetic.max(),
        freedom=511,
    )

    flux, error = of("fig04b", "deterministic", "flux")
    theory = DATA.one("fig04b", "mean-field")["flux"]
    near = [np.abs(theory.axes["x"] - place).argmin() for place in (1 / 30, 1)]
    value, largest = flux[[1, -1], seen] - theory.mean[near, seen], theory.mean.max()
    check(
        FUNCTIONS["C12"](DATA).alternative,
        value.ravel() / largest,
        error[[1, -1], seen].ravel() / largest,
        freedom=191,
    )

    (deterministic, d_error), (rare, r_error) = (
        of(f"fig04{panel}", run, "jump") for panel, run in (("b", "deterministic"), ("a", "rare"))
    )
    value, error = relative_change(*(array[[1, -1]] for array in (rare, deterministic, r_error, d_error)))
    check(FUNCTIONS["C14"](DATA).literal, value + 1, error, freedom=191)

    value, error = (
        np.array(of("fig04b", "equal", "jump"))[:, [1, -1]] / of("fig04b", "equal", "flux")[0].max()
    )
    theory = DATA.one("fig04b", "mean-field-equal")
    x, p, largest = (
        theory["flux"].axes["x"],
        theory["flux"].axes["momentum"],
        of("fig04b", "equal", "flux")[0].max(),
    )
    missed = []
    for place in (x[np.abs(x - 1 / 30).argmin()], 1.0):
        flux, jump = (theory[name].mean[x == place][0] for name in ("flux", "jump"))
        lines = [np.polyfit(p[half], flux[half], 1)[1] for half in (slice(50, 52), slice(48, 50))]
        missed.append(abs(lines[0] - lines[1] - jump))
    check(FUNCTIONS["C31"](DATA).literal, value, error, max(missed) / largest, freedom=191)

"""How far results lie from exact ones where parameters are as large or as small as they can be."""

from collections.abc import Callable, Iterator

import numpy as np

from workflow.lib.load import Result

Run = Callable[..., Result]  # of a program, with options as keywords
Cases = Iterator[tuple[float, float]]  # parameter, relative deviation


def scaled_temperatures(run: Run) -> Cases:
    """Temperatures times 4^k and times over 2^k change the units only."""

    def measure(k: int) -> np.ndarray:
        result = run("persistence", temperature=repr(4.0**k), relaxation_time=0, replicas=2,
                     observation_time=repr(20 * 2.0**-k))  # fmt: skip
        energies = [float(result[name].mean) * 4.0**-k for name in ("particle_energy", "scatterer_energy")]
        return np.array([float(result["mu"].mean), *energies])

    expected = measure(0)
    for k in (-498, -300, -100, -10, 10, 100, 300, 480):
        yield 4.0**k, float(np.abs(measure(k) / expected - 1).max())


def sigma_near(sign: int) -> Callable[[Run], Cases]:
    """Scatterers that began at rest have gained an energy in proportion to 1 - sigma^2."""

    def cases(run: Run) -> Cases:
        def gain(k: int) -> float:
            sigma = sign * (1 - 10.0**-k)
            result = run("persistence", sigma=repr(sigma), relaxation_time=0, observation_time=1, replicas=2)
            distance = 1 - abs(sigma)
            return float(result["scatterer_energy"].mean) / (distance * (2 - distance))

        expected = gain(14)
        for k in (13, 15, 16):
            yield 10.0**-k, abs(gain(k) / expected - 1)

    return cases


def open_chains(run: Run) -> Cases:
    """The same units for a chain between baths whose temperatures differ by 1e8."""

    def measure(k: int) -> np.ndarray:
        rates = {"nu_left": 20 * 2.0**k, "nu_right": 10 * 2.0**k}
        result = run("conductivity", cells=4, replicas=2, temperature_left=repr(4.0**k), start="empty",
                     temperature_right=repr(1e8 * 4.0**k), relaxation_time=0,
                     observation_time=repr(2.0**-k), **rates)  # fmt: skip
        units = {
            "energy_current_plain": 8.0**k,
            "particle_current_plain": 2.0**k,
            "temperature_first": 4.0**k,
        }
        return np.array([float(result[name].mean) / unit for name, unit in units.items()])

    expected = measure(0)
    for k in (-300, -100, -10, 10, 100, 300):
        yield 4.0**k, float(np.abs(measure(k) / expected - 1).max())


def kinetic(gammas: tuple[float, ...], **baths: float) -> Callable[[Run], Cases]:
    """The kinetic equation has to carry its currents through all x alike."""

    def cases(run: Run) -> Cases:
        for gamma in gammas:
            result = run("boltzmann", gamma=gamma, coarsening=2, target_error=1e-6, **baths)
            yield gamma, float(result["current_spread"].mean)

    return cases


def conserved(**chain: float) -> Callable[[Run], Cases]:
    """Drift of energy and momentum."""

    def cases(run: Run) -> Cases:
        result = run("persistence", relaxation_time=0, **chain)
        for name in ("energy_drift", "momentum_drift"):
            yield chain["cells"], float(result[name].mean)

    return cases


CASES = {
    r"$T = 10^{-300} \ldots 10^{289}$": scaled_temperatures,
    r"$T_R/T_L = 10^8$, $T_L = 10^{-181} \ldots 10^{181}$": open_chains,
    r"$\sigma = 1-10^{-k}$, $k = 13 \ldots 16$": sigma_near(1),
    r"$\sigma = -1+10^{-k}$, $k = 13 \ldots 16$": sigma_near(-1),
    "$N = n = 1$": conserved(cells=1, particles_per_cell=1, observation_time=1e5, replicas=2),
    "$N = 10^6$, $n = 1$": conserved(cells=10**6, particles_per_cell=1, observation_time=0.05, replicas=2),
    r"$\gamma \to 0$, kinetic": kinetic((0, 1e-300, 1e-10)),
    r"$\nu_L = 0$, kinetic": kinetic((1,), nu_left=0),
    "$T_R/T_L = 10^8$, kinetic": kinetic((1,), temperature_left=1, temperature_right=1e8),
}
HEATED = {scaled_temperatures, open_chains}  # the parameter is a temperature; elsewhere it is a pure number


def deviations(run: Run) -> Iterator[dict[str, object]]:
    for case, values in CASES.items():
        units = "temperature" if values in HEATED else "1"
        for parameter, deviation in values(run):
            row = {"panel": "extremes", "case": case, "parameter": parameter, "units": units}
            yield row | {"deviation": deviation}

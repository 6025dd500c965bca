"""What the programs of the open chain write, and how a test runs them."""

from pathlib import Path

from tests.python.conftest import Program
from workflow.lib.load import Result, load

UNUSED = {"particles_per_cell": None}

QUANTITIES = {
    "conductivity": {name + suffix: []
                     for name in ("energy_current", "particle_current", "temperature_first", "temperature_last",
                                  "kappa", "kappa_printed", "kappa_particle") for suffix in ("", "_plain")}
                    | {name: [] for name in ("energy_current_drift", "temperature_first_drift",
                                             "temperature_last_drift", "particle_current_drift", "drift_p_value", "current_correlation",
                                             "stationary")}
                    | {"blocking_error": ["length"]},
    "steady_profile": {**{name: ["cell"] for name in ("temperature_scatterer", "temperature_particle", "density",
                                                      "rate_right", "rate_left", "temperature_difference",
                                                      "rate_right_deviation", "rate_left_deviation")},
                       "density_slope": [], "density_excess": ["end"],
                       **{f"{name}_current_deviation": ["bond"] for name in ("particle", "energy")},
                       "particle_current": ["bond"], "energy_current": ["bond"], "particle_current_mean": [],
                       "energy_current_mean": [], "scatterer_density": ["end", "momentum"]},
    "momentum_flux": {"flux": ["bond", "momentum"], "flux_plain": ["bond", "momentum"], "jump": ["bond"],
                      "rate": ["bond", "half"], "square": ["bond", "half"], "kurtosis": ["bond", "half"],
                      "crossings": []},
    "particle_count": {"weighted_momentum_density": ["time", "p"], "weighted_speed_density": ["time", "speed"],
                       "total_number": ["time"], "number_slope": ["time"], "log_slope": [], "log_curvature": [],
                       "plateau": ["time"], "front": ["time"], "front_exponent": []},
}  # fmt: skip


def run(program: Program, folder: Path, name: str, **options: object) -> Result:
    if name == "particle_count":
        options = {"relaxation_time": None, "observation_time": None, "times": "2,5,10", **options}
    done = program(name, **UNUSED | options)
    assert done.returncode == 0, done.stderr
    return load(folder / "out.h5")

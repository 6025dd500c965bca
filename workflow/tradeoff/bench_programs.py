"""Cost of an event of whole programs at their panels' settings, against the event loop that nobody observes."""

import argparse
import statistics
from pathlib import Path

import pandas as pd

from workflow.lib.plan import Run
from workflow.tradeoff.measure import call, planned

RUNS = (  # panel and run
    ("ext07", "energy"),
    ("fig05", "paper_sigma=0.5"),
    ("fig07", "all"),
    ("fig06", "all_sigma=0.5"),
    ("fig08", "deterministic_cells=16"),
    ("fig08", "rare_cells=64"),
    ("fig01", "paper"),
    ("fig04b", "deterministic"),
    ("fig04a", "rare"),
    ("fig02_upper", "deterministic"),
    ("fig02_upper", "rare"),
)
OPEN = ("conductivity", "momentum_flux", "particle_count", "steady_profile")
OF_OBSERVERS = ("momentum-bins", "momentum-max", "decades", "fit-decades", "tail-from", "times")
SECONDS = 1.5  # that a run takes, so that the start of a process does not count
REPETITIONS = 3


def bare(run: Run) -> Run:
    """The same chain for the same time without an observer."""
    options = {key: value for key, value in run.options.items() if key not in OF_OBSERVERS}
    if "times" in run.options:
        options |= {"relaxation-time": 0, "observation-time": run.options["times"].split(",")[-1]}
    return Run(run.name, "bare_open_chain" if run.program in OPEN else "bare_closed_chain", options)


def cost(programs: Path, run: Run, replicas: int) -> tuple[float, float]:
    """CPU seconds, and nanoseconds per event."""
    done = call(programs / run.program, **run.options | {"replicas": replicas, "threads": 1}, progress="none")
    return done.seconds, 1e9 * done.seconds / done.result.provenance["events"]


def row(programs: Path, panel: str, run: Run) -> dict[str, object]:
    """Medians of runs that alternate."""
    replicas = 2  # the least that has errors
    seconds, _ = cost(programs, run, replicas)
    replicas = max(replicas, round(replicas * SECONDS / seconds))
    pairs = [[cost(programs, one, replicas)[1] for one in (run, bare(run))] for _ in range(REPETITIONS)]
    program, loop = (statistics.median(costs) for costs in zip(*pairs, strict=True))
    gamma = run.options.get("gamma", "N")
    return {
        "program": run.program,
        "panel": panel,
        "gamma": gamma,
        "program ns": program,
        "bare loop ns": loop,
        "ratio": program / loop,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=Path, required=True, help="folder of the executables")
    programs = parser.parse_args().programs
    rows = [row(programs, panel, planned(panel, name)) for panel, name in RUNS]
    formatters = {"ratio": "{:.2f}".format}
    print(pd.DataFrame(rows).to_string(index=False, formatters=formatters, float_format="{:.1f}".format))


if __name__ == "__main__":
    main()

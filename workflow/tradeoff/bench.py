"""Nanoseconds per event: the event loop against the reference simulator, and whole programs against the bare loop.

Floor: the same collisions and flights without a queue. Bare loop: the event loop without an observer.
"""

import json
import statistics
import subprocess
from pathlib import Path

import pandas as pd

from workflow.lib.plan import Run
from workflow.tradeoff.measure import PROGRAMS, call, planned

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
SECONDS = 1.5  # of a run, so that the start of a process does not count
REPETITIONS = 3


def event_loops(benchmarks: list[dict]) -> pd.DataFrame:
    """A row per chain from the medians of Google Benchmark."""
    rows = []
    for entry in benchmarks:
        kind, *arguments = entry["run_name"].split("/")
        if not kind.startswith(("closed_", "open_")) or entry.get("aggregate_name", "median") != "median":
            continue
        chain, loop = kind.split("_")
        parameters = dict(word.split(":") for word in arguments if not word.startswith(("iter", "repeats")))
        gamma = parameters.pop("gamma").replace("0", "N")
        size = " ".join(f"{name}={value}" for name, value in parameters.items())
        row = {
            "chain": chain,
            "gamma": gamma,
            "size": size,
            "particles": entry.get("particles"),
            "loop": loop,
        }
        rows.append(row | {"ns": 1e9 / entry["items_per_second"]})
    long = pd.DataFrame(rows)
    case = ["chain", "gamma", "size"]
    table = long.pivot_table(index=case, columns="loop", values="ns", sort=False)
    table.insert(0, "particles", long.groupby(case)["particles"].max())
    table["reference/engine"] = table["reference"] / table["engine"]
    table["engine/floor"] = table["engine"] / table["floor"]
    return table.sort_values(["chain", "gamma", "particles"], ascending=[True, False, True]).reset_index()


def bare(run: Run) -> Run:
    """The same chain for the same time without an observer."""
    options = {key: value for key, value in run.options.items() if key not in OF_OBSERVERS}
    if "times" in run.options:
        options |= {"relaxation-time": 0, "observation-time": run.options["times"].split(",")[-1]}
    return Run(run.name, "bare_open_chain" if run.program in OPEN else "bare_closed_chain", options)


def cost(run: Run, replicas: int) -> tuple[float, float]:
    """CPU seconds, and nanoseconds per event."""
    done = call(run.program, **run.options | {"replicas": replicas, "threads": 1, "progress": "none"})
    return done.seconds, 1e9 * done.seconds / done.result.provenance["events"]


def whole_program(panel: str, run: Run) -> dict[str, object]:
    """Medians of runs that alternate."""
    least = 2  # replicas for which there are errors
    replicas = max(least, round(least * SECONDS / cost(run, least)[0]))
    pairs = [[cost(one, replicas)[1] for one in (run, bare(run))] for _ in range(REPETITIONS)]
    program, loop = (statistics.median(costs) for costs in zip(*pairs, strict=True))
    row = {"program": run.program, "panel": panel, "gamma": run.options.get("gamma", "N")}
    return row | {"program ns": program, "bare loop ns": loop, "program/loop": program / loop}


def show(table: pd.DataFrame) -> None:
    formatters = {"particles": "{:.0f}".format, "program/loop": "{:.2f}".format}
    print(table.to_string(index=False, formatters=formatters, float_format="{:.1f}".format, na_rep="-"))


def main() -> None:
    subprocess.run(["bash", "workflow/environment/build.sh", "benchmarks"], check=True)
    output = Path("build/bench.json")
    options = (
        "repetitions=3",
        "enable_random_interleaving=true",
        "report_aggregates_only=true",
        f"out={output}",
    )
    subprocess.run([PROGRAMS / "benchmarks", *(f"--benchmark_{option}" for option in options)], check=True)
    show(event_loops(json.loads(output.read_text())["benchmarks"]))
    show(pd.DataFrame([whole_program(panel, planned(panel, name)) for panel, name in RUNS]))


if __name__ == "__main__":
    main()

"""Nanoseconds per event: the event loop against the reference simulator, and whole programs against the bare loop.

The floor is the time of collisions and flights without a queue. The bare loop is the event loop without an observer.
"""

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from workflow.plan import Run
from workflow.program import PROGRAMS
from workflow.tradeoff.measure import execute, planned

RUNS = ("ext07/energy", "fig05/paper_sigma=0.5", "fig07/all", "fig06/all_sigma=0.5",
        "fig08/deterministic_cells=16", "fig08/rare_cells=64", "fig01/paper", "fig04b/deterministic", "fig04a/rare",
        "fig02_upper/deterministic", "fig02_upper/rare")  # fmt: skip
OPEN = ("conductivity", "momentum_flux", "particle_count", "steady_profile")
OF_OBSERVERS = ("momentum-bins", "momentum-max", "decades", "fit-decades", "tail-from", "times")
SECONDS = 1.5  # per run, long against the start of a process
REPETITIONS = 3
CHAIN = r"^(?P<chain>closed|open)_(?P<loop>\w+)/(?P<size>.*)/gamma:(?P<gamma>\d)"  # pattern of the name of a benchmark


def event_loops(benchmarks: list[dict[str, Any]]) -> pd.DataFrame:
    """Medians of Google Benchmark, one row per chain."""
    rows = pd.DataFrame(benchmarks).query("aggregate_name == 'median'")
    rows = rows.join(rows.run_name.str.extract(CHAIN)).dropna(subset="chain").replace({"gamma": {"0": "N"}})
    rows["ns"] = 1e9 / rows.items_per_second
    case = ["chain", "gamma", "size"]
    table = rows.pivot_table(index=case, columns="loop", values="ns", sort=False)
    table.insert(0, "particles", rows.groupby(case).particles.max())
    table["reference/engine"] = table.reference / table.engine
    table["engine/floor"] = table.engine / table.floor
    table = table.rename(columns={name: f"{name}, ns" for name in ("engine", "floor", "reference")})
    return table.sort_values(["chain", "gamma", "particles"], ascending=[True, False, True]).reset_index()


def bare(run: Run) -> Run:
    """The same simulation as a run of the bare loop, which has no observer."""
    options = {key: value for key, value in run.options.items() if key not in OF_OBSERVERS}
    if "times" in run.options:
        options |= {"relaxation-time": 0, "observation-time": run.options["times"].split(",")[-1]}
    return Run(run.name, "bare_open_chain" if run.program in OPEN else "bare_closed_chain", options)


def cost(run: Run, replicas: int) -> tuple[float, float]:
    """CPU seconds of a run, and its nanoseconds per event."""
    done = execute(run, replicas=replicas, progress="none")
    return done.seconds, 1e9 * done.seconds / done.result.provenance["events"]


def whole_program(name: str) -> dict[str, object]:
    """Median times per event of a program and of the bare loop, in alternating runs."""
    run = planned(*name.split("/"))
    least = 2  # replicas needed for an error
    replicas = max(least, round(least * SECONDS / cost(run, least)[0]))
    pairs = [[cost(variant, replicas)[1] for variant in (run, bare(run))] for _ in range(REPETITIONS)]
    program, loop = np.median(pairs, axis=0)
    row = {"program": run.program, "run": name, "gamma": run.options.get("gamma", "N")}
    return row | {"program, ns": program, "bare loop, ns": loop, "program/loop": program / loop}


def main() -> None:
    print("Benchmarks take about 7 minutes", flush=True)
    subprocess.run(["bash", "workflow/environment/build.sh", "benchmarks"], check=True)
    output = Path("build/bench.json")
    flags = f"repetitions=3 enable_random_interleaving=true report_aggregates_only=true out={output}".split()
    subprocess.run(
        [PROGRAMS / "benchmarks", *(f"--benchmark_{flag}" for flag in flags)],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    loops = event_loops(json.loads(output.read_text())["benchmarks"])
    programs = pd.DataFrame(map(whole_program, RUNS))
    for title, table in (("Event loops", loops), ("Programs", programs)):
        print(
            f"\n{title}: CPU time per event",
            table.to_string(index=False, float_format="{:.3g}".format, na_rep="-"),
            sep="\n",
        )


if __name__ == "__main__":
    main()

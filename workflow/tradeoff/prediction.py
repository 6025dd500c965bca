"""How well a program foretells what a target error costs: after its first batch, against the CPU seconds spent.

Its products hold measured times, so they change from run to run and do not belong to `make figures`.
"""

import re
from pathlib import Path

import pandas as pd

from workflow.tradeoff import frame
from workflow.tradeoff.accuracy import SETTINGS, window
from workflow.tradeoff.measure import attempt, planned

BATCH = 32
# How many times smaller than the error of the first batch the target is.
EXCESSES = {
    "persistence": 4,
    "waiting_time": 4,
    "displacement": 4,
    "conductivity": 5,
    "steady_profile": 5,
    "energy_pulse": 4,
}
UNITS = {"seconds_foretold": "second", "seconds": "second"}
UNITS |= dict.fromkeys(("target", "replicas_foretold", "replicas", "ratio"), "1")
FORETOLD = re.compile(r"the target needs about (\d+)")


def foretold(said: str) -> int:
    """Replicas, as the program says after its first batch."""
    return int(FORETOLD.search(said)[1])


def compare(programs: Path, program: str, excess: float) -> dict[str, object]:
    panel, name, share = SETTINGS[program]
    run = planned(panel, name)
    changes = window(run, share) | {"replicas": BATCH}
    first = attempt(programs, run, **changes)
    target = first.result.provenance["achieved_error"] / excess
    whole = attempt(programs, run, **changes, target_error=target)
    replicas = foretold(whole.said)
    needed = int(whole.result[whole.result.provenance["target_quantity"]].count)
    row = {"program": program, "target": target, "replicas_foretold": replicas, "replicas": needed}
    row |= {"seconds_foretold": first.seconds * replicas / BATCH, "seconds": whole.seconds}
    return row | {"ratio": row["seconds_foretold"] / row["seconds"]}


def measure(programs: Path) -> pd.DataFrame:
    return pd.DataFrame([compare(programs, *setting) for setting in EXCESSES.items()])


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS)

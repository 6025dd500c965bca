"""How well a program foretells what a target error costs: at its first look, against the CPU seconds spent.

Its products hold measured times, so they change from run to run and do not belong to `make figures`.
"""

import re
from pathlib import Path

import pandas as pd

from workflow.tradeoff import frame
from workflow.tradeoff.accuracy import SETTINGS, window
from workflow.tradeoff.measure import attempt, planned

LEAST, BATCH = 64, 16  # replicas at the first look at the error, and those added at least
# How many times smaller than the error at the first look the target is.
EXCESSES = {
    "persistence": 4,
    "waiting_time": 4,
    "displacement": 4,
    "conductivity": 5,
    "steady_profile": 5,
    "energy_pulse": 4,
}
UNITS = dict.fromkeys(("target", "replicas_least", "replicas_most", "replicas"), "1")
UNITS |= dict.fromkeys(("seconds_least", "seconds_most", "seconds"), "second")
FORETOLD = re.compile(r"the run ends after (\d+) to (\d+)")


def foretold(said: str) -> tuple[int, int]:
    """The least and the most replicas, as the program says at its first look."""
    found = FORETOLD.search(said)
    if found is None:
        raise ValueError("the program does not say when the run ends")
    return int(found[1]), int(found[2])


def compare(programs: Path, program: str, excess: float) -> dict[str, object]:
    panel, name, share = SETTINGS[program]
    run = planned(panel, name)
    changes = window(run, share)
    first = attempt(programs, run, **changes, replicas=LEAST)
    target = first.result.provenance["achieved_error"] / excess
    whole = attempt(programs, run, **changes, replicas=BATCH, target_error=target)
    least, most = foretold(whole.said)
    needed = int(whole.result[whole.result.provenance["target_quantity"]].replicas)
    row = {"program": program, "target": target, "replicas_least": least, "replicas_most": most}
    row |= {"replicas": needed, "as_foretold": least <= needed <= most}
    seconds = {"seconds_least": least, "seconds_most": most}
    return (
        row
        | {key: first.seconds * count / LEAST for key, count in seconds.items()}
        | {"seconds": whole.seconds}
    )


def measure(programs: Path) -> pd.DataFrame:
    return pd.DataFrame([compare(programs, *setting) for setting in EXCESSES.items()])


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS)

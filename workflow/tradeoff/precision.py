"""What the type of the numbers costs in truth: the energy's change over a closed chain's run, for three types."""

import subprocess
from pathlib import Path

import pandas as pd

from workflow.tradeoff import frame
from workflow.tradeoff.measure import planned

KEYS = ("cells", "particles-per-cell", "sigma", "temperature", "observation-time")
CHANGE = "relative change of the energy"
UNITS = {"events": "1", CHANGE: "1"}
SEED = 1


def measure(programs: Path) -> pd.DataFrame:
    """Of the reference simulator, as the engine knows one type only; sigma = 0.3 as in fig. 5."""
    options = planned("fig05", "paper_sigma=0.3").options
    words = [programs / "reference_drift", *(options[key] for key in KEYS), SEED]
    output = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True).stdout
    rows = [line.split() for line in output.splitlines()]
    return pd.DataFrame(rows, columns=["type", "events", CHANGE]).astype({"events": int, CHANGE: float})


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS)

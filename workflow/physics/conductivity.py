"""Heat conductivity of open chains: tables of their runs, and the looks of gases."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from workflow.lib import style
from workflow.lib.load import Result
from workflow.physics import setting

LOOKS = {
    "thinning": ("o", style.BLACK),
    "dilute": ("s", style.SKY),
    "dense": ("^", style.BLUE),
}  # marker and colour by gas


def gas(result: Result) -> str:
    """Name of the gas: the first part of the name of the run."""
    return result.run.partition("_")[0].partition("-")[0]


def spacings(results: Sequence[Result]) -> dict[str, str]:
    """Spacing of every gas, as in the configuration."""
    return {gas(result): setting.spacing(result)[1] for result in results}


def by_spacing(table: pd.DataFrame, spacing: Mapping[str, str]) -> pd.DataFrame:
    """The published table, with the spacing in place of the name of the gas."""
    return table.assign(gas=table.gas.map(spacing)).rename(columns={"gas": "spacing"})


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by N."""
    rows = []
    for result in results:
        row: dict[str, Any] = {"gas": gas(result), "cells": int(result.parameters["cells"])}
        rows.append(
            row | result.columns("kappa", "energy_current", "particle_current") | {"usable": result.usable}
        )
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


def drive(result: Result) -> float:
    """Ratio of the baths' temperatures."""
    left, right = result.ends("temperature")
    return round(right / left, 2)

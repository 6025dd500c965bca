"""Bias of settings: results at several values of a setting, relative to the most careful value."""

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd

from workflow.lib.units import option_units
from workflow.tradeoff.measure import execute, planned

UNITS = {"value": "column value_units", "result": "column units", "result_error": "column units"}


def varied(
    panel: str, name: str, quantity: str, setting: str, values: Sequence[float], **changes: object
) -> Iterator[dict[str, object]]:
    """One row per value of an option, the most careful value last. Of an array the first element is taken."""
    head = {"panel": panel, "start": changes.get("start", ""), "quantity": quantity, "setting": setting}
    for value in values:
        estimate = execute(planned(panel, name), **changes, **{setting: value}).result[quantity]
        mean, error = (float(np.ravel(numbers)[0]) for numbers in (estimate.mean, estimate.error))
        units = {"value_units": option_units().get(setting, "1"), "units": estimate.units}
        yield head | {"value": value, "result": mean, "result_error": error} | units


def with_bias(table: pd.DataFrame) -> pd.DataFrame:
    """Adds the difference relative to the last, most careful value; errors are combined as independent."""
    case = ["panel", "start", "setting", "quantity"]
    last = table.groupby(case)[["result", "result_error"]].transform("last")
    both = np.hypot(table.result_error, last.result_error)
    error = both.where(table.duplicated(case, keep="last"), table.result_error)
    return table.assign(bias=table.result / last.result - 1, bias_error=error / abs(last.result))


def measure() -> pd.DataFrame:
    edge = ("fig08", "deterministic_cells=16", "temperature_first", "relaxation-time", (0.008, 0.08, 0.8, 8))
    rows = [*varied("ext07", "persistence_relaxation-time=1", "mu", "relaxation-time", (0.1, 1, 10, 100),
                    observation_time=12.5, replicas=600)]  # fmt: skip
    for start in ("warm", "empty"):
        rows += varied(*edge, start=start, observation_time=50, replicas=240)
    rows += varied("fig04a", "rare", "jump", "momentum-bins", (10, 20, 50, 100, 200), replicas=60)
    decades = (2, 1.5, 1, 0.5)
    rows += varied("ext07", "spreading_relaxation-time=10", "alpha", "fit-decades", decades, replicas=240)
    return with_bias(pd.DataFrame(rows))

"""Bias of settings: the results at several values of a setting, minus those at the most careful value."""

from collections.abc import Callable, Iterable

import numpy as np
import pandas as pd

from workflow.lib.load import Quantity
from workflow.tradeoff.measure import Done, execute, planned, shortened

REPLICAS = 60
FRACTION = 1 / 8  # of the observation time of the panels
UNITS = {"value": "column value_units", "result": "column units", "error": "column units"}

Row = dict[str, object]


def row(
    setting: str, value: float, units: str, quantity: tuple[str, Quantity], index: int | tuple[()] = ()
) -> Row:
    name, found = quantity
    head = {"setting": setting, "value": value, "value_units": units, "quantity": name}
    return head | {
        "result": float(found.mean[index]),
        "error": float(found.error[index]),
        "units": found.units,
    }


def varied(
    setting: str,
    values: Iterable[float],
    names: Iterable[str],
    run: Callable[[float], Done],
    units: str = "1",
) -> list[Row]:
    """One run per value; of an array the first number is taken."""
    found = [(value, run(value).result) for value in values]
    return [row(setting, value, units, (name, result[name]), 0 if result[name].mean.ndim else ())
            for value, result in found for name in names]  # fmt: skip


def stored(setting: str, panel: str, name: str, quantity: str, values: slice) -> list[Row]:
    """One run, whose file holds the quantity at all values of the setting."""
    found = execute(planned(panel, name), replicas=2 * REPLICAS).result[quantity]
    (axis,) = found.axes.values()
    (units,) = found.axis_units.values()
    return [row(setting, axis[i], units, (quantity, found), i) for i in range(len(axis))[values]]


def with_bias(table: pd.DataFrame) -> pd.DataFrame:
    """Difference relative to the last row of a setting and quantity, the most careful; errors combined as independent."""
    last = table.groupby(["setting", "quantity"])[["result", "error"]].transform("last")
    careful = ~table.duplicated(["setting", "quantity"], keep="last")
    error = np.where(careful, table.error, np.hypot(table.error, last.error)) / abs(last.result)
    return table.assign(bias=table.result / last.result - 1, bias_error=error)


def measure() -> pd.DataFrame:
    closed, open_chain = (
        planned("ext07", "persistence_relaxation-time=1"),
        planned("fig08", "deterministic_cells=16"),
    )
    flux, spreading = planned("fig04a", "rare"), planned("ext07", "spreading_relaxation-time=10")
    windows = [shortened(run.options["observation-time"], FRACTION) for run in (closed, open_chain)]
    relaxation = open_chain.options["relaxation-time"]

    def closed_chain(time: float) -> Done:
        return execute(closed, relaxation_time=time, observation_time=windows[0], replicas=10 * REPLICAS)

    def started(start: str) -> Callable[[float], Done]:
        return lambda fraction: execute(open_chain, relaxation_time=shortened(relaxation, fraction), start=start,
                                        observation_time=windows[1], replicas=4 * REPLICAS)  # fmt: skip

    rows = varied("relaxation time", (0.1, 1, 10, 100), ["mu"], closed_chain, "time")
    for start in ("warm", "empty"):
        rows += varied(f"relaxation over that of fig08, start {start}", (0.01, 0.1, 1, 10),
                       ["kappa", "temperature_first"], started(start))  # fmt: skip
    rows += varied("bins of momentum", (10, 20, 50, 100, 200), ["jump"],
                   lambda count: execute(flux, momentum_bins=count, replicas=REPLICAS))  # fmt: skip
    rows += varied("decades fitted", (2, 1.5, 1, 0.5), ["alpha"],
                   lambda count: execute(spreading, fit_decades=count, replicas=4 * REPLICAS))  # fmt: skip
    rows += stored("first time fitted", "fig09a", "gaussian", "damping_exponent_from", slice(0, -2, 2))
    rows += stored("shortest time of the tail", "fig06", "all_sigma=0.5", "exponent_by_cut", slice(24, 50, 4))
    return with_bias(pd.DataFrame(rows))

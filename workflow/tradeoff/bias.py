"""What each knob costs in truth: the answer at every setting minus the one at the most careful setting.

Its products hold no times, but belong to no panel of the paper.
"""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.load import Result
from workflow.lib.plan import Run
from workflow.tradeoff import frame
from workflow.tradeoff.measure import execute, planned, shortened

REPLICAS = 60
SHARE = 1 / 8  # of the panels' windows
OPEN_CHAIN = ("$T_1$, open chain", "relaxation over that of fig. 8")
KNOBS = {  # what moves, with what
    "relaxation": (r"$\mu$, closed chain", "relaxation time"),
    "relaxation, warm": OPEN_CHAIN,
    "relaxation, empty": OPEN_CHAIN,
    "bins": ("jump of $F$ at $p = 0$", "bins of momentum"),
    "decades": (r"exponent of $\langle x^2\rangle$", "decades of time fitted"),
    "from": ("exponent of damping", "first time fitted"),
    "cut": (r"exponent of $\Psi(\tau)$", "shortest waiting time of the tail"),
}
SETTING_UNITS = {"relaxation": "time", "from": "time", "cut": "time"}  # of the other knobs 1
UNITS = {"setting": "column setting_units", "value": "column units", "error": "column units"}
UNITS |= {"bias": "1", "bias_error": "1"}


def point(
    knob: str, setting: float, result: Result, name: str, index: tuple[int, ...] = ()
) -> dict[str, object]:
    quantity = result[name]
    values = {"value": float(quantity.mean[index]), "error": float(quantity.error[index])}
    row = {"knob": knob, "setting": setting, "setting_units": SETTING_UNITS.get(knob, "1"), "quantity": name}
    return row | values | {"units": quantity.units}


def persistence(programs: Path) -> list[dict[str, Any]]:
    run = planned("ext07", "persistence_relaxation-time=1")
    window = shortened(run.options["observation-time"], SHARE)
    rows = []
    for time in (0.1, 1, 10, 100):
        changes = {"relaxation_time": time, "observation_time": window}
        result, _ = execute(programs, run, **changes, replicas=10 * REPLICAS)
        rows.append(point("relaxation", time, result, "mu"))
    return rows


def conductivity(programs: Path, start: str) -> list[dict[str, Any]]:
    run = planned("fig08", "deterministic_cells=16")
    window = shortened(run.options["observation-time"], SHARE)
    rows = []
    for share in (0.01, 0.1, 1, 10):
        changes = {"relaxation_time": shortened(run.options["relaxation-time"], share), "start": start}
        result, _ = execute(programs, run, **changes, observation_time=window, replicas=4 * REPLICAS)
        names = ("kappa", "temperature_first")
        rows += [point(f"relaxation, {start}", share, result, name) for name in names]
    return rows


def bins(programs: Path) -> list[dict[str, Any]]:
    run = planned("fig04a", "rare")
    return [point("bins", count, execute(programs, run, momentum_bins=count, replicas=REPLICAS)[0], "jump", (0,))
            for count in (10, 20, 50, 100, 200)]  # fmt: skip


def decades(programs: Path) -> list[dict[str, Any]]:
    run = planned("ext07", "spreading_relaxation-time=10")
    return [point("decades", count, execute(programs, run, fit_decades=count, replicas=4 * REPLICAS)[0], "alpha")
            for count in (2, 1.5, 1, 0.5)]  # fmt: skip


def stored(programs: Path, run: Run, knob: str, quantity: str, settings: slice) -> list[dict[str, Any]]:
    """From one run, whose file holds the quantity at every setting; the last of the slice is the careful one."""
    result, _ = execute(programs, run, replicas=2 * REPLICAS)
    axis = result[quantity].axes[knob]
    return [point(knob, axis[i], result, quantity, (i,)) for i in range(len(axis))[settings]]


def with_bias(table: pd.DataFrame) -> pd.DataFrame:
    """Relative difference from the last row of a knob and quantity, with the error of both."""
    last = table.groupby(["knob", "quantity"])[["value", "error"]].transform("last")
    careful = ~table.duplicated(["knob", "quantity"], keep="last")
    bias = table.value / last.value - 1
    error = np.where(careful, table.error, np.hypot(table.error, last.error)) / abs(last.value)
    return table.assign(bias=bias, bias_error=error, careful=careful)


def draw_knob(axes: Axes, part: pd.DataFrame, look: tuple[str, str], label: str | None = None) -> None:
    """The careful setting is an open marker."""
    marker, color = look
    percent = 100 * part[["bias", "bias_error"]]
    bars = {"color": color, "label": label, **style.POINTS}
    axes.errorbar(part.setting, percent.bias, percent.bias_error, marker=marker, **bars)
    careful: style.Look = {"marker": marker, "color": color, "markerfacecolor": "white", "zorder": 4}
    axes.plot(part.setting[part.careful], percent.bias[part.careful], **careful)
    axes.axhline(0, **style.GUIDE)
    title, quantity = KNOBS[part.knob.iloc[0]]
    axes.set(xscale="log", xlabel=quantity)
    axes.set_title(title, size=8)
    if part.setting.max() / part.setting.min() < 50:
        style.label_within_decades(axes.xaxis)


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(2, 3, figsize=(2.1 * style.COLUMN, 1.4 * style.HEIGHT))
    parts = dict(list(table[table.quantity != "kappa"].groupby("knob", sort=False)))
    warm, empty = style.BY_GAMMA.values()
    beside = parts.pop("relaxation, empty").eval("setting = 1.2 * setting")
    draw_knob(axes[0, 1], beside, empty, "starts empty")
    draw_knob(axes[0, 1], parts.pop("relaxation, warm"), warm, "starts warm")
    axes[0, 1].legend(fontsize=7)
    others = [one for one in axes.flat if one is not axes[0, 1]]
    for one, part in zip(others, parts.values(), strict=True):
        draw_knob(one, part, warm)
    figure.supylabel("difference from the most careful setting (per cent)", size=9)
    return figure


def measure(programs: Path) -> pd.DataFrame:
    rows = persistence(programs) + conductivity(programs, "warm") + conductivity(programs, "empty")
    rows += bins(programs) + decades(programs)
    pulse, waiting = planned("fig09a", "gaussian"), planned("fig06", "all_sigma=0.5")
    rows += stored(programs, pulse, "from", "damping_exponent_from", slice(0, -2, 2))
    rows += stored(programs, waiting, "cut", "exponent_by_cut", slice(24, 50, 4))
    return with_bias(pd.DataFrame(rows))


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS, draw)

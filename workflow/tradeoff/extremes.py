"""Rounding at the extremes: drift of the conserved quantities against the number of events, and how far results
lie from exact ones where parameters are as large or as small as they can be.

It is measured with the programs themselves; no time enters.
"""

from collections.abc import Iterator
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.load import Result
from workflow.tradeoff import frame
from workflow.tradeoff.deviations import CASES, Run, deviations
from workflow.tradeoff.measure import call

SIGMAS = {0.5: "0.5", 0.3: "0.3", -0.9: "$-0.9$", 1 - 1e-12: r"$1-10^{-12}$"}
LOOKS = dict(zip(SIGMAS, zip("osv^", (style.BLACK, style.BLUE, style.VERMILLION, style.ORANGE), strict=True),
                 strict=True))  # fmt: skip
LONGEST = {"smoke": 6, "standard": 8, "paper": 10, "deep": 10}  # log10 of the events of one run
UNITS = {"parameter": "column units"} | dict.fromkeys(("events", "deviation", "error"), "1")
UNIT = 2.0**-53
EXACT = 1e-19  # where a deviation of 0 is drawn


def drifts(run: Run, longest: int) -> Iterator[dict[str, object]]:
    """Long runs are few: the mean of so many magnitudes has an error of 0.75 over their root."""
    for sigma in SIGMAS:
        rate = 4000.0  # events per unit time; it falls as energy goes over to the scatterers
        for power in np.arange(5, longest + 0.25, 0.5):
            replicas = int(np.clip(10 ** (8 - power), 2, 16))
            time = 10**power / rate
            result = run("persistence", sigma=repr(sigma), relaxation_time=0, replicas=replicas,
                         observation_time=time)  # fmt: skip
            events = result.provenance["events"] / replicas
            rate = events / time
            for name in ("energy_drift", "momentum_drift"):
                yield {"panel": "drift", "case": name, "parameter": sigma, "units": "1", "events": events,
                       "deviation": float(result[name].mean),
                       "error": float(result[name].error)}  # fmt: skip


def draw_drift(axes: Axes, table: pd.DataFrame) -> None:
    for (name, sigma), rows in table.groupby(["case", "parameter"]):
        marker, colour = LOOKS[sigma]
        energy = name == "energy_drift"
        label = rf"$\sigma$ = {SIGMAS[sigma]}" if energy else None
        axes.errorbar(rows.events, rows.deviation, rows.error, fmt=marker, color=colour, label=label, markersize=3.5,
                      markerfacecolor=colour if energy else "white", markeredgewidth=0.8, linewidth=0.8)  # fmt: skip
    events = np.array([table.events.min(), table.events.max()])
    axes.plot(events, UNIT * np.sqrt(events), **style.GUIDE)
    axes.text(events[0], 4 * UNIT * np.sqrt(events[0]), r"$2^{-53}\sqrt{\mathrm{events}}$", fontsize=8)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="events",
        ylabel="relative drift",
        ylim=(3e-18, 10 * UNIT * np.sqrt(events[1])),
    )
    axes.legend(
        fontsize=7, loc="lower right", ncols=2, title="filled: energy, open: momentum", title_fontsize=7
    )


def draw_extremes(axes: Axes, table: pd.DataFrame) -> None:
    order = list(CASES)
    rows = table.case.map(order.index)
    axes.plot(table.deviation.clip(lower=EXACT), rows, "o", color=style.BLUE, markerfacecolor="none")
    axes.axvline(UNIT, **style.GUIDE)
    axes.text(1.3 * UNIT, -0.45, "$2^{-53}$", fontsize=7, va="center")
    axes.set(xscale="log", xlim=(EXACT / 3, 1e-8), xlabel="relative deviation from the exact result")
    axes.set_yticks(range(len(order)), order, fontsize=7)
    axes.set_ylim(len(order) - 0.4, -0.8)
    axes.set_xticks(
        [EXACT, 1e-16, 1e-14, 1e-12, 1e-10], ["0", *(f"$10^{{{k}}}$" for k in (-16, -14, -12, -10))]
    )
    axes.tick_params(which="minor", bottom=False, top=False, left=False, right=False)


def draw(table: pd.DataFrame) -> Figure:
    figure, (upper, lower) = plt.subplots(
        2, figsize=(1.2 * style.COLUMN, 1.9 * style.HEIGHT), height_ratios=(3, 2.3)
    )
    draw_drift(upper, table[table.panel == "drift"])
    draw_extremes(lower, table[table.panel == "extremes"])
    return figure


def measure(programs: Path, quality: str) -> pd.DataFrame:
    def run(name: str, **options: object) -> Result:
        return call(programs / name, **options, progress="none").result

    return pd.DataFrame([*drifts(run, LONGEST[quality]), *deviations(run)])


def growth(rows: pd.DataFrame) -> pd.Series:
    """The longest run and the power of the number of events with which the drift grows; a random walk's is 1/2."""
    power = np.polyfit(np.log(rows.events), np.log(rows.deviation), 1)[0]
    longest = rows.loc[rows.events.idxmax()]
    return pd.Series({"events": longest.events, "drift": longest.deviation, "power": power})


def summary(table: pd.DataFrame) -> str:
    """Growth of the drifts, and the largest deviation of every case."""
    drift = table[table.panel == "drift"].assign(sigma=table.parameter.map(repr))
    drift = drift.groupby(["case", "sigma"])[["events", "deviation"]].apply(growth)
    largest = table[table.panel == "extremes"].groupby("case", sort=False).deviation.max()
    return f"{drift.to_string()}\n{largest.to_string()}"


if __name__ == "__main__":
    quality = {"choices": LONGEST, "help": "how long the longest runs are"}
    frame.run(measure, __doc__, UNITS, draw, summary, quality=quality)

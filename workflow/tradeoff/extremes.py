"""Rounding: conserved quantities against the number of events, extreme parameters, and types of numbers."""

from collections.abc import Iterator

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.load import Result
from workflow.tradeoff.measure import call, planned, simulate

LOOKS = {  # marker, colour and label by sigma
    0.5: ("o", style.BLACK, "0.5"),
    0.3: ("s", style.BLUE, "0.3"),
    -0.9: ("v", style.VERMILLION, "$-0.9$"),
    1 - 1e-12: ("^", style.ORANGE, r"$1-10^{-12}$"),
}
DRIFTS = ("energy_drift", "momentum_drift")
CHAINS = {
    "$N = n = 1$": {"cells": 1, "particles_per_cell": 1, "observation_time": 1e5},
    "$N = 10^6$, $n = 1$": {"cells": 10**6, "particles_per_cell": 1, "observation_time": 0.05},
}
KINETIC = {
    r"$\gamma \to 0$, kinetic": [{"gamma": gamma} for gamma in (0, 1e-300, 1e-10)],
    r"$\nu_L = 0$, kinetic": [{"gamma": 1, "nu_left": 0}],
    "$T_R/T_L = 10^8$, kinetic": [{"gamma": 1, "temperature_left": 1, "temperature_right": 1e8}],
}
UNIT = 2.0**-53
EXACT = 1e-19  # where a deviation of 0 is plotted

Row = dict[str, object]


def persistence(**options: object) -> Result:
    return call("persistence", **{"relaxation_time": 0, "replicas": 2, "progress": "none"} | options).result


def drifts(longest: float) -> Iterator[Row]:
    """Closed chains of 10^5 to 10^longest events. The mean of a few magnitudes has an error of 0.75 over their root."""
    for sigma in LOOKS:
        rate = 4000.0  # events per unit time; it falls as energy goes over to the scatterers
        for power in np.arange(5, longest + 0.25, 0.5):
            replicas, time = int(np.clip(10 ** (8 - power), 2, 16)), 10**power / rate
            result = persistence(sigma=repr(sigma), replicas=replicas, observation_time=time)
            events = result.provenance["events"] / replicas
            rate = events / time
            for name in DRIFTS:
                row = {"panel": "drift", "case": name, "parameter": sigma, "events": events}
                yield row | {"deviation": float(result[name].mean), "error": float(result[name].error)}


def gain(sigma: float) -> float:
    """Energy that scatterers gain from rest, over 1 - sigma^2, to which it is proportional close to |sigma| = 1."""
    energy = persistence(sigma=repr(sigma), observation_time=1)["scatterer_energy"].mean
    distance = 1 - abs(sigma)
    return float(energy) / (distance * (2 - distance))


def deviations() -> Iterator[tuple[str, float, float]]:
    """Case, parameter, relative deviation from the exact result: from proportionality to 1 - sigma^2, and of
    conserved quantities and of the currents of the kinetic equation from constancy."""
    for sign, edge in ((1, "1-"), (-1, "-1+")):
        expected = gain(sign * (1 - 1e-14))
        for k in (13, 15, 16):
            found = gain(sign * (1 - 10.0**-k))
            yield rf"$\sigma = {edge}10^{{-k}}$, $k = 13 \ldots 16$", 10.0**-k, abs(found / expected - 1)
    for case, chain in CHAINS.items():
        result = persistence(**chain)
        yield from ((case, chain["cells"], float(result[name].mean)) for name in DRIFTS)
    for case, settings in KINETIC.items():
        for options in settings:
            result = call("boltzmann", coarsening=2, target_error=1e-6, progress="none", **options).result
            yield case, options["gamma"], float(result["current_spread"].mean)


def power_of_growth(rows: pd.DataFrame) -> float:
    """Of the drift with the number of events; that of a random walk is 1/2."""
    return float(np.polyfit(np.log(rows.events), np.log(rows.deviation), 1)[0])


def measure(longest: float) -> pd.DataFrame:
    drift = pd.DataFrame(drifts(longest))
    groups = drift.groupby(["case", "parameter"])[["events", "deviation"]]
    drift = drift.merge(groups.apply(power_of_growth).rename("power").reset_index())
    extremes = pd.DataFrame(deviations(), columns=["case", "parameter", "deviation"]).assign(panel="extremes")
    return pd.concat([drift, extremes], ignore_index=True)


def draw_drift(axes: Axes, table: pd.DataFrame) -> None:
    for (name, sigma), rows in table.groupby(["case", "parameter"]):
        marker, colour, label = LOOKS[sigma]
        energy = name == "energy_drift"
        look = {"markersize": 3.5, "markeredgewidth": 0.8, "linewidth": 0.8, "color": colour}
        look |= {"markerfacecolor": colour if energy else "white"}
        look |= {"label": rf"$\sigma$ = {label}"} if energy else {}
        axes.errorbar(rows.events, rows.deviation, rows.error, fmt=marker, **look)
    events = np.array([table.events.min(), table.events.max()])
    walk = UNIT * np.sqrt(events)
    axes.plot(events, walk, **style.GUIDE)
    axes.text(events[0], 4 * walk[0], r"$2^{-53}\sqrt{\mathrm{events}}$", fontsize=8)
    axes.set(xscale="log", yscale="log", xlabel="events", ylabel="relative drift", ylim=(3e-18, 10 * walk[1]))
    axes.legend(
        fontsize=7, loc="lower right", ncols=2, title="filled: energy, open: momentum", title_fontsize=7
    )


def draw_extremes(axes: Axes, table: pd.DataFrame) -> None:
    cases = [*table.case.unique()]
    axes.plot(
        table.deviation.clip(lower=EXACT), table.case.map(cases.index), "o", color=style.BLUE, mfc="none"
    )
    axes.axvline(UNIT, **style.GUIDE)
    axes.text(1.3 * UNIT, -0.45, "$2^{-53}$", fontsize=7, va="center")
    axes.set(xscale="log", xlim=(EXACT / 3, 1e-8), xlabel="relative deviation from the exact result")
    axes.set_yticks(range(len(cases)), cases, fontsize=7)
    axes.set_ylim(len(cases) - 0.4, -0.8)
    powers = range(-16, -9, 2)
    axes.set_xticks([EXACT, *(10.0**k for k in powers)], ["0", *(f"$10^{{{k}}}$" for k in powers)])
    axes.tick_params(which="minor", bottom=False, top=False, left=False, right=False)


def draw(table: pd.DataFrame) -> Figure:
    size = (1.2 * style.COLUMN, 1.8 * style.HEIGHT)
    figure, (upper, lower) = plt.subplots(2, figsize=size, height_ratios=(3, 2))
    draw_drift(upper, table[table.panel == "drift"])
    draw_extremes(lower, table[table.panel == "extremes"])
    return figure


def types() -> pd.DataFrame:
    """Change of the energy of a closed chain of the reference simulator for three types of floating-point numbers."""
    options, names = planned("fig05", "paper_sigma=0.3").options, ("cells", "particles-per-cell", "sigma")
    names += ("temperature", "observation-time")
    lines, _ = simulate("drift", *map(options.get, names), 1)
    table = pd.DataFrame(lines, columns=["type", "events", "relative_change"])
    return table.astype({"events": int, "relative_change": float})

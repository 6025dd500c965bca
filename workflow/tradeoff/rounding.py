"""Rounding: drift of conserved quantities with the number of events, and effect of the floating-point type."""

from collections.abc import Iterator

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.tradeoff.measure import call, planned, simulate

LONGEST = 8  # log10 of the events of the longest runs
SIGMAS = ("0.5", "0.3", "-0.9", "0.999999999999")
LOOKS = dict(zip(SIGMAS, zip("osv^", style.SEQUENCE[:4], strict=True), strict=True))


def drifts() -> Iterator[tuple[object, ...]]:
    """Closed chains of 10^5 to 10^LONGEST events. The mean of R magnitudes has a relative error of 0.75/sqrt(R)."""
    for sigma in SIGMAS:
        rate = 4000.0  # events per unit time; falls as energy flows to the scatterers
        for power in np.arange(5, LONGEST + 0.25, 0.5):
            replicas, time = int(np.clip(10 ** (8 - power), 2, 16)), 10**power / rate
            result = call("persistence", sigma=sigma, relaxation_time=0, observation_time=time,
                          replicas=replicas, progress="none").result  # fmt: skip
            events = result.provenance["events"] / replicas
            rate = events / time
            for name in ("energy_drift", "momentum_drift"):
                yield name, sigma, events, float(result[name].mean), float(result[name].error)


def measure() -> pd.DataFrame:
    """Drifts with the exponent of their growth with the number of events: 1/2 for a random walk."""
    table = pd.DataFrame(drifts(), columns=["quantity", "sigma", "events", "drift", "error"])
    curves = np.log(table.set_index(["quantity", "sigma"])[["events", "drift"]]).groupby(level=[0, 1])
    powers = curves.apply(lambda rows: np.polyfit(rows.events, rows.drift, 1)[0])
    return table.merge(powers.rename("power").reset_index())


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(figsize=(1.2 * style.COLUMN, 1.1 * style.HEIGHT))
    for (name, sigma), rows in table.groupby(["quantity", "sigma"]):
        marker, colour = LOOKS[sigma]
        energy = name == "energy_drift"
        look: style.Look = {"label": rf"$\sigma = {sigma}$"} if energy else {"markerfacecolor": "white"}
        axes.errorbar(rows.events, rows.drift, rows.error, color=colour, marker=marker, linewidth=0.8, **look)
    events = np.array([table.events.min(), table.events.max()])
    walk = 2.0**-53 * np.sqrt(events)
    axes.plot(events, walk, **style.GUIDE)
    axes.text(events[0], 4 * walk[0], r"$2^{-53}\sqrt{\mathrm{events}}$", fontsize=8)
    axes.set(xscale="log", yscale="log", xlabel="events", ylabel="relative drift", ylim=(3e-18, 10 * walk[1]))
    axes.legend(fontsize=7, loc="lower right", ncols=2, title="filled: energy, open: momentum")
    return figure


def measure_types() -> pd.DataFrame:
    """Change of the energy of a closed chain of the reference simulator for three floating-point types."""
    options = planned("fig05", "paper_sigma=0.3").options
    names = ("cells", "particles-per-cell", "sigma", "temperature", "observation-time")
    rows, _ = simulate("drift", **{name: options[name] for name in names}, seed=1)
    kinds = {"type": str, "events": int, "relative_change": float}
    return pd.DataFrame(rows, columns=[*kinds]).astype(kinds)

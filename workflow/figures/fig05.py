"""Fig. 5: persistence mu against the mass ratio sigma, with the law arccos(sigma)/pi, and with what the
conservation of the total momentum makes of it [eq. 10]."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds, plots, require
from workflow.lib.load import Result
from workflow.lib.text import format_number, format_with_error, listed
from workflow.physics.closed import persistence_at_momentum, persistence_law
from workflow.physics.run_parameters import mass

TITLE = "Persistence probability against the mass ratio"
UNITS = dict.fromkeys(("law", "deviation", "at_momentum"), "1")

DASHED = style.DASHES[3]
LOOKS = {
    "paper": style.points("o", style.BLUE, label=r"$n = {}$, random $\Pi$"),
    "zero-momentum": style.points("s", style.VERMILLION, "white", label=r"$n = {}$, $\Pi = 0$"),
    "dense": style.points("^", style.GREEN, label=r"$n = {}$, random $\Pi$"),
}
RELAXED = 0.8  # least energy of a relaxed scatterer, over that of a particle, as they meet


def has_relaxed(result: Result) -> bool:
    """Whether the scatterers have relaxed. At σ = ±1 they have no energy, or keep theirs."""
    scatterer, particle = (float(result[f"{one}_energy"].mean) for one in ("scatterer", "particle"))
    return bool(abs(result.parameters["sigma"]) == 1 or scatterer >= RELAXED * particle)


def at_momentum(result: Result) -> float:
    """mu by eq. 10 for the measured temperature: at large N and n, collisions have a common T, which is twice
    the mean energy of particles and of scatterers before them. Their energy leaves the rest of E to slow
    particles. At σ = 0 nothing relaxes, as momenta are only exchanged."""
    sigma, cells = float(result.parameters["sigma"]), int(result.parameters["cells"])
    # The total momentum is that of the particles if scatterers start at rest.
    if sigma in (-1, 0, 1) or not has_relaxed(result) or not holds([result], scatterer_temperature=0):
        return np.nan
    energy = cells * result.parameters["particles_per_cell"] * float(result.parameters["temperature"])  # 2 E
    temperature = float(result["particle_energy"].mean + result["scatterer_energy"].mean)
    total_mass = cells * mass(result) + energy / temperature - cells
    momentum = 0 if result.parameters["zero_total_momentum"] else energy / temperature
    return persistence_at_momentum(sigma, total_mass, momentum)


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, by series and sigma."""
    rows = [
        {
            "series": result.series,
            "particles_per_cell": int(result.parameters["particles_per_cell"]),
            "sigma": float(result.parameters["sigma"]),
            **result.columns("mu"),
            "at_momentum": at_momentum(result),
            "particle_energy": float(result["particle_energy"].mean),
            "scatterer_energy": float(result["scatterer_energy"].mean),
            "relaxed": has_relaxed(result),
            "replicas": int(result["mu"].replicas),
            "usable": result.usable,
        }
        for result in results
    ]
    table = pd.DataFrame(rows).sort_values(["series", "sigma"], ignore_index=True)
    table.insert(5, "law", persistence_law(table.sigma))
    table.insert(6, "deviation", table.mu - table.law)
    return table


def caption(table: pd.DataFrame) -> str:
    largest = {}
    for name, part in table[table.relaxed].groupby("series"):
        far = part.loc[part.deviation.abs().idxmax()]
        largest[name] = format_with_error(abs(far.deviation), far.mu_error)
    others = [*map(format_number, sorted({*table[~table.relaxed].sigma}))]
    but = f" except at σ = {listed(others)}, where heavy scatterers have not relaxed" if others else ""
    text = f"""The paper states the probability μ that a particle keeps its direction as an integral, which
        with a missing factor 2 is arccos(σ)/π. (b) Difference from this law: in the paper's ring at most
        {{paper}}{but}. With {{density}} particles per cell it is at most {{dense}}. Dashed: the law
        corrected for the conserved total momentum Π."""
    n = {str(cells) for cells in table[table.series == "dense"].particles_per_cell}
    density = listed(sorted(n)) if n else None
    numbers = {name: largest.get(name) for name in ("paper", "dense")}
    return fill(text, density=density, **numbers)


@plots("paper zero-momentum dense", varied="particles_per_cell")
def draw(results: Sequence[Result]) -> Parts:
    require("the law arccos(σ)/π", results)
    table = tabulate(results)
    figure, (above, below) = style.stacked(2.2, 1.4, height=1.5)
    sigma = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 401))
    above.plot(sigma, persistence_law(sigma), color=style.BLACK, label=r"$\arccos(\sigma)/\pi$", zorder=1)
    below.axhline(0, color=style.BLACK, zorder=1)
    for name in dict.fromkeys([*(name for name in LOOKS if name in {*table.series}), *table.series]):
        look = LOOKS.get(name, style.points("P", style.BLACK, "white", label=name))
        part = table[table.series == name]
        numbers = listed(map(str, sorted(part.particles_per_cell.unique())))
        look = look | {"label": look["label"].format(numbers)}
        above.errorbar(part.sigma, part.mu, part.mu_error, **look)
        below.errorbar(part.sigma, 1e3 * part.deviation, 1e3 * part.mu_error, **look)
        expected = 1e3 * (part.at_momentum - part.law)
        below.plot(part.sigma, expected, color=look["color"], linestyle=DASHED, zorder=1)
    style.cross_out(above, table.sigma, table.mu, ~table.usable)
    above.plot([], [], color="grey", linestyle=DASHED, label=r"at conserved $\Pi$")
    above.set(ylabel=r"persistence $\mu$", xlim=(-1.04, 1.04), ylim=(-0.03, 1.03))
    above.legend(loc="upper right", title=f"$N = {results[0].parameters['cells']}$")
    for sigma, part in table[~table.relaxed].groupby("sigma"):
        side, lift = ("right", 4) if sigma > 0 else ("left", -4)
        lowest = sigma, 1e3 * part.deviation.min()
        style.name_point(below, "scatterers not relaxed", lowest, (lift, -6), ha=side, va="top")
    below.margins(y=0.2)  # room for their name
    below.set(xlabel=r"mass ratio $\sigma = (M-m)/(M+m)$", ylabel=r"$10^3\,[\mu - \arccos(\sigma)/\pi]$")
    return figure, table, caption(table)

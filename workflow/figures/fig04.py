"""Fig. 4: momentum distribution of the particles at both ends of an open chain; a: gamma = 1, b: gamma = N.

Below, the surroundings of p = 0, where the distribution jumps; in b also with equal rates at both ends. Black: without
correlations, that is, the kinetic equation in a, as many scatterers of it in b.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Quantity, Result

NEAR = 12  # momenta shown in the lower panel


def plot_bond(axes: Axes, result: Result, bond: int, **look: object) -> None:
    """F over its bins, in the middle, with errors; the halves are not joined."""
    flux = result["flux"]
    momentum = flux.axes["momentum"]
    label = look.pop("label", None)
    for half in (momentum < 0, momentum > 0):
        mean, error = flux.mean[bond][half], flux.standard_error[bond][half]
        axes.errorbar(momentum[half], mean, error, elinewidth=0.8, label=label, **look)
        label = None


def row_at(flux: Quantity, x: float) -> np.ndarray:
    """F of the kinetic equation at a place."""
    return flux.mean[np.abs(flux.axes["x"] - x).argmin()]


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    (kinetic,) = (result for result in results if result.provenance["program"] == "boltzmann")
    results = [result for result in results if result is not kinetic]
    figure, (above, below) = plt.subplots(2, 1, figsize=(style.COLUMN, 1.8 * style.HEIGHT))
    tables = []
    fills = [{}, {"alpha": 0.45}]
    for result, fill in zip(results, fills, strict=False):
        flux, jump = result["flux"], result["jump"]
        last = flux.mean.shape[0] - 1
        momentum = flux.axes["momentum"]
        rates = ", ".join(f"{result.parameters[f'nu-{end}']:g}" for end in ("left", "right"))
        ends = [(1, style.BLUE, "solid", "x = 1/N"), (last, style.VERMILLION, (0, (4, 1.5)), "x = 1")]
        for bond, color, dashes, place in ends:
            look = {"color": color, "linestyle": dashes, **fill}
            label = rf"${place}$: jump {style.with_error(jump, bond)}"
            if not fill:
                plot_bond(above, result, bond, **look, label=f"${place}$")
            plot_bond(below, result, bond, **look, label=rf"$\nu = {rates}$, {label}")
            table = pd.DataFrame({"x": place, "momentum": momentum, "flux": flux.mean[bond]})
            table["flux_error"] = flux.standard_error[bond]
            expected = row_at(kinetic["flux"], bond / last)
            if not fill:
                table["kinetic"] = expected
                for half in (momentum < 0, momentum > 0):
                    for axes in (above, below):
                        axes.plot(momentum[half], expected[half], color=style.BLACK, linewidth=0.6, zorder=1)
            table["jump"], table["jump_error"] = jump.mean[bond], jump.standard_error[bond]
            table["nu_left"], table["nu_right"] = (
                result.parameters[f"nu-{end}"] for end in ("left", "right")
            )
            tables.append(table)
    main = results[0]["flux"].mean[[1, -1]]
    near = np.abs(results[0]["flux"].axes["momentum"]) < NEAR
    low, high = main[:, near].min(), main.max()
    below.set(xlim=(-NEAR, NEAR), ylim=(low, high + 0.45 * (high - low) * len(results)))
    for axes in (above, below):
        axes.axvline(0, **style.GUIDE)
        axes.set(xlabel="momentum $p$", ylabel="$F_N(p, x)$")
    below.set_xlabel(f"momentum $p$ ({style.UNITS})")
    above.legend(loc="upper right", title=rf"$\gamma = {style.gamma(results[0])}$")
    below.legend(loc="upper center", fontsize=6.5, **style.OPAQUE)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Momentum distribution of the particles at both ends", kinetic="1/(time momentum)")

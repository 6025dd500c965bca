"""Options of every program over their whole domain, drawn by hypothesis."""

import numpy as np
from hypothesis import strategies as st

LIMITS = [1 - 10.0**-k for k in range(1, 17)]
RULES = [
    {"rule": "random-direction"},
    {"rule": "reversal", "reversal-probability": 0.1},
]  # rules other than the default
SIGMAS = st.sampled_from([0.0, 1.0, -1.0, 5e-324, *LIMITS, *(-x for x in LIMITS)]) | st.floats(-1, 1)
MAGNITUDES = st.floats(-31, 31)  # log10 of a number with units, also slightly beyond the allowed range
FLIGHTS = st.floats(-3, 2) | st.floats(-60, -20)  # log10 of the number of flights of a run that ends soon


def powers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


def number(exponent: float) -> str:
    """A power of ten as text, which may be outside the range of a double."""
    whole = int(np.floor(exponent))
    return f"{10 ** (exponent - whole):.6f}e{whole}"


@st.composite
def closed(draw: st.DrawFn) -> dict[str, object]:
    cells = draw(st.integers(1, 4))
    temperature, length = draw(MAGNITUDES), draw(MAGNITUDES)
    flight = length - temperature / 2  # log10 of the time of a thermal flight
    options = {
        "cells": cells,
        "particles-per-cell": draw(st.integers(1, 3)),
        "sigma": repr(draw(SIGMAS)),
        "gamma": draw(st.sampled_from(["N", cells, 0.5, 1e-30])),
        "cell-length": number(length),
        "temperature": number(temperature),
        "scatterer-temperature": draw(
            st.just("0") | st.floats(-20, 4).map(lambda x: number(temperature + x))
        ),
        "relaxation-time": draw(st.just("0") | FLIGHTS.map(lambda x: number(flight + x))),
        "observation-time": number(flight + draw(FLIGHTS)),
    }
    return options | draw(st.sampled_from([{}, {"zero-total-momentum": True}, *RULES]))


@st.composite
def displaced(draw: st.DrawFn) -> dict[str, object]:
    return draw(closed()) | {"decades": draw(st.sampled_from([1, 6, 15]))}


@st.composite
def aged(draw: st.DrawFn) -> dict[str, object]:
    return draw(closed()) | {"decades": draw(st.sampled_from([1, 6, 15])),
                             "fit-decades": draw(st.sampled_from([0.25, 1, 15]))}  # fmt: skip


@st.composite
def pulsed(draw: st.DrawFn) -> dict[str, object]:
    options = draw(closed()) | {"cells": draw(st.integers(6, 9)), "pairs-per-replica": 2}
    options["energy"] = options.pop("temperature")
    pulse = float(options["energy"]) * draw(powers(-6, 3))
    last = options.pop("observation-time")
    options.pop("zero-total-momentum", None)
    mantissa, exponent = last.split("e")
    return options | {"pulse-energy": repr(pulse), "times": f"{mantissa}e{int(exponent) - 1},{last}"}


@st.composite
def equilibrium(draw: st.DrawFn) -> dict[str, object]:
    options = draw(closed())
    for name in (
        "particles-per-cell",
        "gamma",
        "scatterer-temperature",
        "relaxation-time",
        "zero-total-momentum",
    ):
        options.pop(name, None)
    flux = draw(st.floats(-2, 1) | st.floats(-60, 60)) - np.log10(float(str(options["cell-length"])))
    mantissa, exponent = str(options["observation-time"]).split("e")
    first = f"{mantissa}e{int(exponent) - 1}"
    options |= {"cells": draw(st.integers(1, 30)), "fugacity": number(flux), "fit-from": first}
    options |= {"times": f"{first},{options['observation-time']}"}
    return options


@st.composite
def correlated(draw: st.DrawFn) -> dict[str, object]:
    options = draw(equilibrium()) | {"cells": draw(st.integers(7, 30))}
    options.pop("fit-from")
    return options


@st.composite
def opened(draw: st.DrawFn) -> dict[str, object]:
    cells = draw(st.integers(1, 4))
    temperature, length = draw(MAGNITUDES), draw(MAGNITUDES)
    contrast = draw(st.floats(-8, 8))
    flight = length - max(temperature, temperature + contrast) / 2
    last = flight + draw(FLIGHTS | st.floats(13, 60))  # the clock would not resolve many flights
    # Number of particles injected in all: few, or more than possible.
    rates = st.just("0") | (st.floats(-60, 3) | st.floats(16, 60)).map(lambda x: number(x - last))
    return {
        "cells": cells,
        "sigma": repr(draw(SIGMAS)),
        "gamma": draw(st.sampled_from(["N", cells, 0.5, 0, 1e-300])),
        "cell-length": number(length),
        "nu-left": draw(rates),
        "nu-right": draw(rates),
        "temperature-left": number(temperature),
        "temperature-right": number(temperature + contrast),
        "start": draw(st.sampled_from(["empty", "warm"])),
        **draw(st.sampled_from([{}, *RULES])),
        "relaxation-time": draw(st.sampled_from(["0", number(last - 1), number(last + 1)])),
        "observation-time": number(last),
    }


@st.composite
def binned(draw: st.DrawFn) -> dict[str, object]:
    options = draw(opened())
    scale = float(options["temperature-left"]) ** 0.5
    options["momentum-max"] = repr(scale * draw(powers(-3, 3) | powers(-30, 30)))
    return options | {"momentum-bins": draw(st.sampled_from([2, 4, 20]))}


@st.composite
def counted(draw: st.DrawFn) -> dict[str, object]:
    options = draw(binned())
    options.pop("relaxation-time")
    last = options.pop("observation-time")
    mantissa, exponent = last.split("e")
    return options | {"times": f"{mantissa}e{int(exponent) - 1},{last}"}


@st.composite
def kinetic(draw: st.DrawFn) -> dict[str, object]:
    temperature, rate = draw(MAGNITUDES), draw(MAGNITUDES)
    rates = st.just("0") | st.floats(-8, 8).map(lambda x: number(rate + x))
    scale = 10 ** (temperature / 2)
    return {
        "sigma": repr(draw(st.sampled_from([-0.99, 0.0, 5e-324, 0.99]) | st.floats(-0.99, 0.99))),
        "gamma": draw(st.sampled_from([0, 1e-300, 1, 50])),
        "nu-left": draw(rates),
        "nu-right": draw(rates),
        "temperature-left": number(temperature),
        "temperature-right": number(temperature + draw(st.floats(-8, 8))),
        "momentum-bins": 4,
        "momentum-max": repr(scale * draw(powers(-3, 3) | powers(-30, 30))),
        "target-error": 1e-3,
        "coarsening": 4,
    }


PROGRAMS = {
    "persistence": closed(),
    "waiting_time": closed(),
    "displacement": displaced(),
    "ageing": aged(),
    "energy_pulse": pulsed(),
    "correlation": correlated(),
    "heat_current": equilibrium(),
    "steady_profile": binned(),
    "momentum_flux": binned(),
    "conductivity": opened(),
    "particle_count": counted(),
    "boltzmann": kinetic(),
}

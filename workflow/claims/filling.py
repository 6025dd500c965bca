"""Claims on the chain that fills (fig. 1), at the spacing 1/N of the paper's other open chains, as it states none for this one."""

import math

import numpy as np

from workflow.claims.data import Claim, Data, Evidence, combination, number, ratio
from workflow.claims.verdict import Number
from workflow.lib.fit import fit_multiple, with_error
from workflow.lib.load import Result

SPACINGS = {"paper": "1", "short": "0.05"}  # the two other spacings by run; not every quality has both


def stationary_above_front(data: Data) -> Evidence:
    """Relative changes of |p| n_t(p) above p_0 from each time to the next."""
    by_spacing = _others(data)
    changes = [_rise(run, 0, -1) for run in by_spacing.values()]
    pairs = zip(by_spacing, changes, strict=True)
    texts = [f"λ = {name}: {with_error(change.value, change.error)}" for name, change in pairs]
    result = data.one("fig01", "unit-chain")
    later = range(1, len(result["plateau"].mean))
    return Evidence(
        [_rise(result, k - 1, k) for k in later],
        alternative=changes,
        caveat=f"The paper states no spacing; judged at 1/N. From the first time to the last it rises at {' and at '.join(texts)}.",
    )


def grows_as_logarithm(data: Data) -> Evidence:
    """dn/d ln t is constant, and equal to |p| n_t(p) above p_0."""
    result = data.one("fig01", "unit-chain")
    slope, plateau = number(result, "log_slope"), number(result, "plateau", -1)
    label = "change of the slope per unit of ln t, relative"
    curvature = ratio(number(result, "log_curvature"), slope, label)
    agreement = ratio(slope, plateau, "slope over |p| n(p), minus 1").over(1, 1)
    times = result["plateau"].axes["time"]
    steps = math.log(times[-1] / times[0])
    rise = combination([_rise(result, 0, -1)], [1 / steps], "change of |p| n(p) per unit of ln t, relative")
    return Evidence([curvature, agreement], [rise], caveat="At the spacing 1/N.")


def front_falls(data: Data) -> Evidence:
    """Exponent of p_0(t). For p_0 ~ 1/ln t it would be -1/ln t."""
    result = data.one("fig01", "unit-chain")
    by_spacing = _others(data)
    exponents = [number(run, "front_exponent", label=f"at λ = {name}") for name, run in by_spacing.items()]
    misfits = [f"{_misfits(run)} at λ = {name}" for name, run in {"1/N": result, **by_spacing}.items()]
    return Evidence(
        [number(result, "front_exponent", label="d ln p₀ / d ln t at λ = 1/N")],
        alternative=exponents,
        caveat=f"χ² of the five fronts for p₀ ~ 1/t and ~ 1/ln t: {', '.join(misfits)}, with 4 degrees of freedom.",
    )


def _others(data: Data) -> dict[str, Result]:
    """Results at the two other spacings, as far as the quality has them, by spacing."""
    names = {run.name for run in data.plan["fig01"].runs}
    return {spacing: data.one("fig01", run) for run, spacing in SPACINGS.items() if run in names}


def _rise(result: Result, first: int, last: int) -> Number:
    plateau = result["plateau"]
    times = plateau.axes["time"]
    label = f"change from t = {times[first]:g} to {times[last]:g}"
    return ratio(number(result, "plateau", last), number(result, "plateau", first), label).over(1, 1)


def _misfits(result: Result) -> str:
    """χ² of the fits p_0 ~ 1/t and p_0 ~ 1/ln t, as text."""
    front = result["front"]
    time = front.axes["time"]
    return " and ".join(
        f"{fit_multiple(law, front.mean, front.error)[2]:.0f}" for law in (1 / time, 1 / np.log(time))
    )


CLAIMS: dict[str, Claim] = {"C01": stationary_above_front, "C02": grows_as_logarithm, "C03": front_falls}

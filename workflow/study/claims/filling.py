"""Claims on the chain that fills (fig. 1), at the spacing 1/N of the paper's other open chains, as it
states none for this one."""

from dataclasses import replace

from workflow.study.results import Results, estimate, ratio
from workflow.study.verdict import Estimate

RUN = "unit-chain"


def stationary_above_front(data: Results) -> list[Estimate]:
    """Relative changes of |p| n_t(p) above p_0 from each time to the next."""
    result = data.one("fig01", RUN)
    times = result["plateau"].axes["time"]
    changes = []
    for k in range(1, len(times)):
        label = f"change of |p| n_t(p) from t = {times[k - 1]:g} to {times[k]:g}"
        before, after = (estimate(result, "plateau", index) for index in (k - 1, k))
        changes.append(ratio(after, before, label) - 1)
    return changes


def grows_logarithmically(data: Results) -> list[Estimate]:
    """Minus the exponent of p_0(t), which is dn/d ln t over the height of |p| n_t(p) above p_0, minus 1. Only the
    slow particles enter; those above p_0 are stationary (C01)."""
    front = estimate(data.one("fig01", RUN), "front_exponent")
    return [replace(front / -1 - 1, label="(dn/d ln t)/(|p| n_t(p)) - 1, by p₀")]


def front_falls(data: Results) -> list[Estimate]:
    """Exponent of p_0(t). For p_0 ~ 1/ln t it would be -1/ln t."""
    return [estimate(data.one("fig01", RUN), "front_exponent", label="d ln p₀/d ln t")]

"""Claims on the chain that fills (fig. 1), at the spacing 1/N of the paper's other open chains, as it
states none for this one."""

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
    """dn/d ln t over the height of |p| n_t(p) above p_0 at the last time, minus 1. The errors of both are
    correlated; that of the height is a tenth of the other."""
    result = data.one("fig01", RUN)
    slope, height = estimate(result, "log_slope"), estimate(result, "plateau", -1)
    return [ratio(slope, height, "(dn/d ln t)/(|p| n_t(p)) - 1") - 1]


def front_falls(data: Results) -> list[Estimate]:
    """Exponent of p_0(t). For p_0 ~ 1/ln t it would be -1/ln t."""
    return [estimate(data.one("fig01", RUN), "front_exponent", label="d ln p₀/d ln t")]

"""Setting of a run, from the parameters of its result: gamma, spacing of the scatterers, rates of the
baths."""

from collections.abc import Sequence

from workflow.lib.load import Result


def both_rates(result: Result) -> float:
    """ν_L + ν_R. Divided by it, the flux has an integral of about 1, as in the paper."""
    return sum(result.ends("nu"))


def gamma(result: Result) -> str:
    """Value of gamma as text: N or a number; `none` of a program without it."""
    return str(result.parameters.get("gamma", "none")).removesuffix(".0")


def mass(result: Result) -> float:
    """M of a scatterer, from σ = (M - 1)/(M + 1)."""
    sigma = float(result.parameters["sigma"])
    return (1 + sigma) / (1 - sigma)


def spacing(result: Result) -> tuple[float, str]:
    """Distance between scatterers as a number and as text."""
    given = result.parameters["cell_length"]
    if given == "1/N":
        return 1 / int(result.parameters["cells"]), "1/N"
    return float(given), f"{given}".removesuffix(".0")


def length(result: Result) -> float:
    """Length of a chain."""
    return spacing(result)[0] * int(result.parameters["cells"])


def in_order_of_spacing(results: Sequence[Result]) -> list[Result]:
    """In ascending order, so that 1/N, the spacing of the paper's other chains, is first."""
    return sorted(results, key=lambda result: spacing(result)[0])

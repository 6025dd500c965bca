"""Judges every claim of data/claims.csv by the results at one quality."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from workflow.claims import closed, filling, fluxes, growth, profiles, pulse
from workflow.claims.data import Claim, Data, Evidence, MissingError
from workflow.claims.verdict import Band, Outcome, Reading, combined, level_of_each
from workflow.configuration import ConfigurationError
from workflow.lib.load import NOT_REACHED

CLAIMS_FILE = "data/claims.csv"
READINGS = ["literal", "intended", "alternative"]
COLUMNS = ["id", "panel", "place", "quantity", "paper", "criterion", *READINGS]
MODULES = (filling, profiles, fluxes, closed, growth, pulse)
FUNCTIONS: dict[str, Claim] = {name: claim for module in MODULES for name, claim in module.CLAIMS.items()}


@dataclass(frozen=True)
class Judgement:
    """A claim with its verdict. claim is its row in the table; literal is None where there is nothing to judge by."""

    claim: Mapping[str, str]
    outcome: Outcome
    literal: Reading | None = None
    intended: Reading | None = None
    alternative: Reading | None = None
    caveat: str = ""
    data: tuple[str, ...] = ()  # paths of the result files that it depends on

    @property
    def deciding(self) -> Reading | None:
        """The reading that the verdict follows from. A claim is contradicted in its intended meaning, if it has one."""
        if self.intended and self.intended.outcome is self.outcome is Outcome.CONTRADICTED:
            return self.intended
        literally = self.intended is None or self.literal is None or self.outcome is self.literal.outcome
        return self.literal if literally else self.intended


def read_claims(root: Path) -> list[dict[str, str]]:
    """Rows of the table of claims. Raises ConfigurationError, OSError."""
    try:
        table = pd.read_csv(root / CLAIMS_FILE, dtype=str, keep_default_na=False)[COLUMNS]
        rows: list[dict[str, str]] = table.to_dict("records")
        if unmatched := {row["id"] for row in rows} ^ FUNCTIONS.keys():
            raise ValueError(f"{min(unmatched)} has no row there or no function in workflow/claims: add it")
        for band in (row[reading] for row in rows for reading in READINGS if row[reading]):
            Band.of(band)
    except (ValueError, KeyError) as error:  # errors of pandas are ValueErrors
        raise ConfigurationError(f"{CLAIMS_FILE}: {error}") from error
    return rows


def judge_all(data: Data) -> list[Judgement]:
    claims = read_claims(data.root)
    return [judge(claim, data.anew(), level_of_each(len(claims))) for claim in claims]


def judge(claim: Mapping[str, str], data: Data, level: float) -> Judgement:
    try:
        evidence = FUNCTIONS[claim["id"]](data)
    except MissingError as error:
        return Judgement(claim, Outcome.NOT_TESTABLE, caveat=f"{error}.")
    judged = level / (2 if evidence.intended else 1)
    literal, intended = (_reading(claim, evidence, name, judged) for name in ("literal", "intended"))
    alternative = _reading(claim, evidence, "alternative", level)
    literally = literal.outcome if literal else Outcome.NOT_TESTABLE
    outcome = combined(literally, intended.outcome if intended else None)
    short = [path for path, result in data.used.items() if result.converged == NOT_REACHED]
    unconverged = [f"{len(short)} runs stopped before their target error."] if short else []
    caveat = " ".join([evidence.caveat, *unconverged]).strip()
    return Judgement(claim, outcome, literal, intended, alternative, caveat, tuple(data.used))


def _reading(claim: Mapping[str, str], evidence: Evidence, name: str, level: float) -> Reading | None:
    numbers = tuple(getattr(evidence, name))
    return Reading(Band.of(claim[name]), numbers, level) if numbers else None

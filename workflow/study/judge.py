"""Judges every statement of workflow/study/claims.csv by results.

A row is a statement of the paper as printed, or as meant if that is another one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pandas as pd

from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError
from workflow.study.claims import closed, filling, fluxes, growth, profiles, pulse
from workflow.study.results import Claim, MissingError, Results
from workflow.study.verdict import Band, Outcome, Verdict, level_of_each

CLAIMS_FILE = "workflow/study/claims.csv"
COLUMNS = ["number", "kind", "place", "statement", "short", "panel", "function"]
COLUMNS += ["band", "nearly", "criterion", "caveat"]
MOST_LETTERS = 60  # of a statement in the picture of the verdicts: `short`, or `statement` without one
PRINTED, MEANT = KINDS = ("as printed", "as meant")
MODULES = {
    module.__name__.rpartition(".")[2]: module
    for module in (closed, filling, fluxes, growth, profiles, pulse)
}


@dataclass(frozen=True)
class Judgement:
    """A statement with its verdict. missing: why there are no numbers, else empty."""

    row: Mapping[str, str]
    verdict: Verdict
    missing: str = ""


def function_of(row: Mapping[str, str]) -> Claim:
    """The function `module.name` that measures the numbers of a row. Raises KeyError, AttributeError."""
    module, _, name = row["function"].partition(".")
    function: Claim = getattr(MODULES[module], name)
    return function


def bands(row: Mapping[str, str]) -> tuple[Band, Band | None]:
    """The acceptance band, and the wider one of a nearly reproduced statement. Raises ValueError."""
    return Band.parse(row["band"]), Band.parse(row["nearly"]) if row["nearly"] else None


def label(row: Mapping[str, str]) -> str:
    """The statement in at most MOST_LETTERS letters."""
    return row["short"] or row["statement"]


def read_claims(root: Path) -> list[dict[str, str]]:
    """Rows of the table of statements. Raises FormatError, OSError."""
    where = "the table"
    try:
        table = pd.read_csv(root / CLAIMS_FILE, dtype=str, keep_default_na=False)[COLUMNS]
        rows: list[dict[str, str]] = table.to_dict("records")
        for row in rows:
            where = f"row {row['number']}, {row['kind']}"
            bands(row)
            function_of(row)
            if row["kind"] not in KINDS:
                raise ValueError(f"{row['kind']} is not a kind: write {' or '.join(KINDS)}")
            if len(label(row)) > MOST_LETTERS:
                raise ValueError(
                    f"'{label(row)}' has more than {MOST_LETTERS} letters: write it shorter in `short`"
                )
    except (ValueError, KeyError, AttributeError) as error:  # errors of pandas are ValueErrors
        raise FormatError(f"{CLAIMS_FILE}: {where}: {error}") from error
    return rows


def judge_all(data: Results, root: Path = ROOT) -> list[Judgement]:
    """Raises FormatError, also if a result was modified, OSError."""
    rows = read_claims(root)
    return [judge(row, data, level_of_each(len(rows))) for row in rows]


def judge(row: Mapping[str, str], data: Results, level: float) -> Judgement:
    band, nearly = bands(row)
    try:
        return Judgement(row, Verdict(band, tuple(function_of(row)(data)), level, nearly))
    except MissingError as error:
        return Judgement(row, Verdict(band, (), level, nearly), str(error))


def changed(judgements: Sequence[Judgement], factor: float) -> list[tuple[Judgement, Outcome]]:
    """Rows whose verdict is another one if every band with two edges is wider by a factor, with this
    verdict."""
    others = []
    for one in judgements:
        band, nearly = one.verdict.band.wider(factor), one.verdict.nearly
        verdict = replace(one.verdict, band=band, nearly=nearly.wider(factor) if nearly else None)
        others.append((one, verdict.outcome))
    return [(one, outcome) for one, outcome in others if outcome is not one.verdict.outcome]

"""Numbers and verdicts of the front page."""

import csv
import re

from tests.python.conftest import ROOT

with (ROOT / "docs/gallery/numbers.csv").open(newline="") as file:
    RELEASE = [*csv.DictReader(file)]


def test_front_page_has_the_numbers_of_the_release() -> None:
    """A number with its errors in brackets, as 0.299(8)(52), is one of the report, rounded. Detected
    mistake: a systematic error that is not negligible is missing."""
    text = (ROOT / "README.md").read_text().replace("−", "-")
    found = re.findall(r"(-?\d+\.(\d+))\((\d+)\)(?:\((\d+)\))?", text)
    assert found
    for value, decimals, *errors in found:
        digits = len(decimals)
        assert any(
            f"{float(line['value']):.{digits}f}" == value
            and [round(float(line[kind]) * 10**digits) for kind in ("error", "systematic")]
            == [int(error or 0) for error in errors]
            for line in RELEASE
        ), (value, errors)


def test_front_page_has_the_verdicts_of_the_release() -> None:
    printed = {line["claim"]: line["claim_verdict"] for line in RELEASE if line["kind"] == "as printed"}
    outcomes = ("reproduced", "nearly reproduced", "contradicted", "undecided")
    held, nearly, failed, undecided = map([*printed.values()].count, outcomes)
    count = f"{held} of the paper's {len(printed)} statements are reproduced, {nearly} nearly, {failed} "
    count += f"contradicted and {undecided} undecided"
    text = (ROOT / "README.md").read_text()
    assert re.search(count, " ".join(text.split()))
    assert "@" not in text  # a number that is not filled in

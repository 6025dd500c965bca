"""Records of costs are of use, and never in the way."""

from pathlib import Path

import pytest

from workflow.lib.costs import read_cost


@pytest.mark.parametrize("text", ["{", "{}", '"text"', "[]", '{"cpu_seconds": "1"}', "\0"])
def test_a_damaged_record_is_none(tmp_path: Path, text: str) -> None:
    (tmp_path / "cost.json").write_text(text)
    assert read_cost(tmp_path / "cost.json") is None
    assert read_cost(tmp_path / "none.json") is None


def test_a_record_is_read(tmp_path: Path) -> None:
    (tmp_path / "cost.json").write_text('{"cpu_seconds": 1.5, "events": 7}')
    assert read_cost(tmp_path / "cost.json") == {"cpu_seconds": 1.5, "events": 7}

"""Records of costs are of use, and never in the way."""

import math
from pathlib import Path

import pytest

from workflow.lib import costs
from workflow.lib.costs import effort, expected_cost, peak_memory, read_cost
from workflow.lib.plan import Run


@pytest.mark.parametrize(
    "text",
    [
        "{",
        "{}",
        '"text"',
        "[]",
        '{"cpu_seconds": "1"}',
        "\0",
        "[" * 100000,
        '{"cpu_seconds": 0.0}',
        '{"cpu_seconds": -3.0}',
        '{"cpu_seconds": NaN}',
    ],
)
def test_a_damaged_record_is_none(tmp_path: Path, text: str) -> None:
    (tmp_path / "cost.json").write_text(text)
    assert read_cost(tmp_path / "cost.json") is None
    assert read_cost(tmp_path / "none.json") is None


def test_a_record_is_read(tmp_path: Path) -> None:
    (tmp_path / "cost.json").write_text('{"cpu_seconds": 1.5, "events": 7}')
    assert read_cost(tmp_path / "cost.json") == {"cpu_seconds": 1.5, "events": 7}


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"cells": "continuum"}, 1),
        ({"cells": 20, "replicas": 3, "observation-time": 10, "relaxation-time": "5+0.05N"}, 48),
        ({"replicas": 2, "pairs-per-replica": 4, "times": "0.1,0.5", "observation-time": 9}, 4),
    ],
)
def test_effort(options: dict, expected: float) -> None:
    assert effort(options) == pytest.approx(expected)


def test_a_run_of_another_size_foretells_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """A series of one size has none in its name, and may have another at another quality."""
    executed = {"cells": 32, "replicas": 4, "observation-time": 1}
    monkeypatch.setattr(costs, "load_parameters", lambda _: executed)
    monkeypatch.setattr(costs, "cost_file", lambda *_: {"cpu_seconds": 2.0})
    run = Run("large", "conductivity", {"cells": 32, "replicas": 8})
    assert expected_cost("fig08", run, 0.0) == (4, 4)
    other = Run("large", "conductivity", {"cells": 512, "replicas": 8})
    assert all(map(math.isnan, expected_cost("fig08", other, 0.0)))


def test_memory_is_foretold_by_the_series(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    executed = {
        "a_cells=16": (16, 20e6),
        "a_cells=64": (64, 30e6),
        "ab_cells=512": (512, 70e6),
        "c": (11, 9e6),
    }
    folder = tmp_path / "build/costs/standard/fig08"
    folder.mkdir(parents=True)
    for name, (_, peak) in executed.items():
        (folder / f"{name}.json").write_text(f'{{"cpu_seconds": 1.0, "peak_memory_bytes": {peak}}}')
    monkeypatch.setattr(costs, "ROOT", tmp_path)
    monkeypatch.setattr(costs, "load_parameters", lambda path: {"cells": executed[path.stem][0]})
    for cells, expected in ((64, 80e6), (256, 320e6), (8, 30e6)):
        assert peak_memory("fig08", Run("", "conductivity", {"cells": cells}, series="a")) == expected
    assert math.isnan(peak_memory("fig08", Run("", "conductivity", {"cells": 64}, series="b")))

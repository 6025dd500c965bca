"""Criteria for equal products of a job: the same bytes, equality up to rounding, or agreement within errors."""

from pathlib import Path

import pytest

from tests.python.conftest import Program
from workflow.provenance import redo
from workflow.provenance.lock import Job
from workflow.provenance.redo import disagreement, redrawn, same_bytes, tables_agree
from workflow.provenance.repository import machine
from workflow.provenance.verify import SIGNIFICANCE

ENOUGH = {"replicas": 16, "observation_time": 50, "relaxation_time": 20}


@pytest.mark.parametrize("seeds", [(1, 2), (3, 4), (5, 6), (7, 8)])
def test_independent_runs_agree_within_errors(
    persistence: Program, tmp_path: Path, seeds: tuple[int, int]
) -> None:
    paths = [tmp_path / f"{seed}.h5" for seed in seeds]
    for seed, path in zip(seeds, paths, strict=True):
        assert persistence(seed=seed, output=path, **ENOUGH).returncode == 0
    assert not same_bytes(*paths)
    largest, probability = disagreement(*paths)
    assert 0 < largest < 6
    assert probability > SIGNIFICANCE


@pytest.mark.parametrize("other", [{"sigma": 0.6}, {"sigma": -0.5}, {"particles_per_cell": 1}])
def test_other_physics_does_not(persistence: Program, tmp_path: Path, other: dict) -> None:
    paths = [tmp_path / "one.h5", tmp_path / "other.h5"]
    long = ENOUGH | {"replicas": 64, "observation_time": 200}
    persistence(seed=1, output=paths[0], **long | {"sigma": 0.5})
    persistence(seed=2, output=paths[1], **long | {"sigma": 0.5} | other)
    assert disagreement(*paths)[1] < SIGNIFICANCE


def test_another_layout_is_no_match(persistence: Program, program: Program, tmp_path: Path) -> None:
    persistence(output=tmp_path / "one.h5")
    program("waiting_time", output=tmp_path / "other.h5")
    assert disagreement(tmp_path / "one.h5", tmp_path / "other.h5")[1] == 0


@pytest.mark.parametrize(
    ("text", "agrees"),
    [("a,b\n1,2.0000000001\n", True), ("a,b\n1,2.00001\n", False), ("a,c\n1,2\n", False), ("a,b\n", False)],
)
def test_tables_agree_but_for_rounding(tmp_path: Path, text: str, agrees: bool) -> None:
    one, other = tmp_path / "one.csv", tmp_path / "other.csv"
    one.write_text("# title\na,b\n1,2.0\n")
    other.write_text(f"# title\n{text}")
    assert tables_agree(one, other) is agrees


@pytest.mark.parametrize(
    ("place", "number", "differing"),
    [
        (machine(), "2.0000000001", {"a.csv": False, "a.png": False}),
        ("elsewhere", "2.0000000001", {"a.csv": True, "a.png": True}),
        ("elsewhere", "2.00001", {"a.csv": False, "a.png": True}),
    ],
)
def test_rounding_explains_other_bytes_elsewhere_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str, number: str, differing: dict[str, bool]
) -> None:
    files = {"a.csv": ("a\n2.0\n", f"a\n{number}\n"), "a.png": ("old", "new"), "a.svg": ("same", "same")}
    for name, (old, new) in files.items():
        (tmp_path / name).write_text(old)
        (tmp_path / f"again_{name}").write_text(new)
    monkeypatch.setattr(redo, "ROOT", tmp_path)
    monkeypatch.setattr(redo, "draw", lambda *_: {name: tmp_path / f"again_{name}" for name in files})
    assert redrawn(Job("", {}, {}, {}, None, None, place, 0), tmp_path) == differing

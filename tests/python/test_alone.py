"""What the start of Snakemake takes away, and what is told of errors that are not the project's."""

import json
from pathlib import Path

import pytest

from workflow.execution import alone


@pytest.mark.parametrize("damage", [b"\xff\xfe", b"3", b"", b"[" * 100_000, b'{"half": '])
def test_damaged_notes_of_snakemake_are_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: bytes
) -> None:
    """As the loss of power leaves them, after which Snakemake would end in a traceback for ever."""
    notes = tmp_path / "metadata"
    (notes / "long").mkdir(parents=True)
    for name, content in (("whole", json.dumps({"version": 6}).encode()), ("long/damaged", damage)):
        (notes / name).write_bytes(content)
    monkeypatch.setattr(alone, "PLACE", tmp_path)
    alone.remove_damaged_notes()
    assert [path.name for path in notes.rglob("*") if path.is_file()] == ["whole"]


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (NotADirectoryError(20, "Not a directory", "/home/.cache"), "/home/.cache: Not a directory\n"),
        (OSError(24, "Too many open files"), "[Errno 24] Too many open files\n"),
        (MemoryError(), "There is not enough memory\n"),
        (KeyError("a"), ""),
    ],
)
def test_errors_of_the_system_are_told_in_one_line(
    capsys: pytest.CaptureFixture, error: Exception, line: str
) -> None:
    left: list[Exception] = []
    alone.told_by(lambda _, other: left.append(other))(None, error)
    assert capsys.readouterr().err == line
    assert left == ([] if line else [error])

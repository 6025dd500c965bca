"""Files that say nothing of their parents, or say it wrong, are refused in one line, whatever they hold."""

import json
import os
import resource
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from workflow.lib.columns import as_csv
from workflow.lib.parents import ArtefactError, Parents
from workflow.lib.save import Text, save

KINDS = ("pdf", "png", "svg", "csv")
BUILD = {name: "" for name in ("program", "source_hash", "compiler", "flags", "libraries")}
PARENTS = Parents(
    "fig05",
    "smoke",
    {"a.h5": {"sha256": "0", "build_id": "1", "seed": 1}},
    {"1": BUILD},
    {"a.py": "2"},
    "3",
    "3.11",
    "4",
)


@pytest.fixture
def stem(tmp_path: Path) -> Path:
    figure, _ = plt.subplots()
    save(
        figure,
        as_csv(pd.DataFrame({"a": [1.0]}), {"a": "1"}),
        tmp_path / "a",
        Text("title", "caption"),
        PARENTS,
    )
    plt.close(figure)
    return tmp_path / "a"


def test_what_cannot_be_written_leaves_nothing(tmp_path: Path) -> None:
    figure, _ = plt.subplots()
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    table = as_csv(pd.DataFrame({"a": [1.0]}), {"a": "1"})
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limit[1]))
    try:
        with pytest.raises(OSError, match=r"File too large: '.*a\.pdf\.tmp'"):
            save(figure, table, tmp_path / "a", Text("title", "caption"), PARENTS)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        plt.close(figure)
    assert [*tmp_path.iterdir()] == []


def refusal(path: Path) -> str:
    with pytest.raises(ArtefactError) as raised:
        Parents.of(path)
    assert "\n" not in str(raised.value)
    return str(raised.value)


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_saved_is_read(stem: Path, kind: str) -> None:
    assert Parents.of(stem.with_suffix(f".{kind}")) == PARENTS


@pytest.mark.parametrize("kind", KINDS)
def test_a_damaged_file_is_refused(stem: Path, kind: str) -> None:
    path = stem.with_suffix(f".{kind}")
    whole = path.read_bytes()
    for size in (0, 1, 9, 50, 200):
        path.write_bytes(whole[:size])
        assert "names no parents" in refusal(path)
    for start in range(0, len(whole), max(1, len(whole) // 50)):
        path.write_bytes(whole[:start] + bytes(range(255, 215, -1)) + whole[start + 40 :])
        try:
            Parents.of(path)
        except ArtefactError as error:
            assert "names no parents" in str(error)  # noqa: PT017  # damage elsewhere leaves the parents readable


@pytest.mark.parametrize(
    "change",
    [
        {"panel": 5},
        {"data": []},
        {"data": {"a.h5": {}}},
        {"data": {"a.h5": {"sha256": "0", "build_id": "none", "seed": 1}}},
        {"builds": {"1": {}}},
        {"sources": {"a.py": None}},
        {"more": ""},
    ],
)
def test_another_structure_is_refused(tmp_path: Path, change: dict) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"# title\n# parents: {json.dumps(vars(PARENTS) | change)}\n")
    assert "names no parents as this version does" in refusal(path)


def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    assert "No such file" in refusal(tmp_path / "none.csv")
    os.mkfifo(tmp_path / "queue.csv")
    assert "not a file" in refusal(tmp_path / "queue.csv")
    (tmp_path / "folder.pdf").mkdir()
    assert "not a file" in refusal(tmp_path / "folder.pdf")

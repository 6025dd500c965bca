"""Files are compared and hashed in pieces: data may be larger than the memory."""

import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest

from workflow.environment import build_by_content
from workflow.lib.parents import file_hash
from workflow.provenance import build_id
from workflow.provenance.redo import same_bytes

LARGE = 1 << 24  # bytes


@pytest.mark.parametrize(
    "read",
    [lambda path: same_bytes(path, path), file_hash, build_id.content_hash, build_by_content.hash_of],
    ids=["same_bytes", "file_hash", "build_id", "build_by_content"],
)
def test_no_file_is_held_as_a_whole(tmp_path: Path, read: Callable[[Path], object]) -> None:
    path = tmp_path / "large"
    with path.open("wb") as file:
        file.truncate(LARGE)
    tracemalloc.start()
    try:
        assert read(path)
        assert tracemalloc.get_traced_memory()[1] < LARGE / 10
    finally:
        tracemalloc.stop()


def test_files_of_one_length_may_differ(tmp_path: Path) -> None:
    (tmp_path / "one").write_bytes(b"0")
    (tmp_path / "other").write_bytes(b"1")
    assert not same_bytes(tmp_path / "one", tmp_path / "other")

"""Checkpoints lie on the disk of the node, and in the shared folder whenever the job may end."""

import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from workflow.provenance.scratch import scratch

MEMORY = Path("/dev/shm")  # another file system than that of the tests
NAMES = ("0-3.part.checkpoint", "0-3.part.checkpoint.old")


@pytest.fixture
def shared(tmp_path: Path) -> Path:
    return tmp_path / "0-3.part"


@pytest.fixture
def disk(shared: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Of the node."""
    if not MEMORY.is_dir() or MEMORY.stat().st_dev == shared.parent.stat().st_dev:
        pytest.skip("one file system only")
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        monkeypatch.setattr(tempfile, "tempdir", folder)
        yield Path(folder)


def named(output: Path, index: int) -> Path:
    return output.with_name(NAMES[index])


def stopped(shared: Path, end: BaseException, program: Callable[[Path], object]) -> None:
    with scratch(shared) as own:
        program(own)
        raise end


def test_a_program_that_succeeds_leaves_its_result_and_no_checkpoint(shared: Path, disk: Path) -> None:
    for index in (0, 1):
        named(shared, index).write_text(f"{index}")
    with scratch(shared) as own:
        assert own.parent.parent == disk
        assert [named(own, index).read_text() for index in (0, 1)] == ["0", "1"]
        own.write_text("result")
        own.with_name("0-3.part.cost.json").write_text("{}")
        for index in (0, 1):
            named(own, index).unlink()
    assert sorted(path.name for path in shared.parent.iterdir()) == ["0-3.part", "0-3.part.cost.json"]
    assert shared.read_text() == "result"
    assert not list(disk.iterdir())


@pytest.mark.parametrize("end", [SystemExit, KeyboardInterrupt])
def test_the_checkpoint_of_a_job_that_is_ended_is_there_for_the_next(
    shared: Path, disk: Path, end: type[BaseException]
) -> None:
    named(shared, 0).write_text("before")
    with pytest.raises(end):
        stopped(shared, end(), lambda own: named(own, 0).write_text("after"))
    assert [path.name for path in shared.parent.iterdir()] == [NAMES[0]]
    assert named(shared, 0).read_text() == "after"
    assert not list(disk.iterdir())


def test_what_was_there_stays_if_the_node_has_nothing_newer(shared: Path, disk: Path) -> None:
    named(shared, 0).write_text("before")
    with pytest.raises(SystemExit):
        stopped(shared, SystemExit(), lambda own: named(own, 0).unlink())
    assert named(shared, 0).read_text() == "before"


@pytest.mark.usefixtures("disk")
def test_checkpoints_are_copied_while_the_job_runs(shared: Path) -> None:
    with scratch(shared, interval=0.01) as own:
        named(own, 0).write_text("on the way")
        soon_there(named(shared, 0))


@pytest.mark.usefixtures("disk")
def test_what_cannot_be_copied_on_the_way_does_not_end_the_job(shared: Path) -> None:
    """A folder lies in the place of the checkpoint for a while."""
    with scratch(shared, interval=0.01) as own:
        named(shared, 0).mkdir()
        named(own, 0).write_text("on the way")
        time.sleep(0.1)
        named(shared, 0).rmdir()
        soon_there(named(shared, 0))


def soon_there(path: Path) -> None:
    deadline = time.monotonic() + 60
    while not path.is_file():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_without_a_disk_of_its_own_the_shared_folder_serves(
    shared: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(shared.parent))
    with scratch(shared) as own:
        assert own == shared
        own.write_text("result")
        named(own, 0).write_text("left")
    assert sorted(path.name for path in shared.parent.iterdir()) == ["0-3.part", NAMES[0]]

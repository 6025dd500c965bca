"""What lies where a file belongs is told before it is opened, and a file is moved whole, also to another disk."""

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from workflow.claims import judge
from workflow.lib import layout
from workflow.lib.citation import CITATION, citation
from workflow.lib.parents import file_hash
from workflow.lib.places import move, regular, require_place
from workflow.lib.plan import load_plan
from workflow.provenance import repository, stale
from workflow.provenance.chain import Chain
from workflow.provenance.repository import write_whole
from workflow.tradeoff.timings import read_timings

OTHERS: dict[str, Callable[[Path], object]] = {"folder": Path.mkdir, "pipe": os.mkfifo}


@pytest.mark.parametrize("kind", OTHERS)
def test_only_a_file_is_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    """Each of these would wait for ever for someone who writes into the pipe."""
    place = tmp_path / "data/claims.csv"
    place.parent.mkdir()
    OTHERS[kind](place)
    for name in ("lock.tmp", CITATION):
        OTHERS[kind](tmp_path / name)
    monkeypatch.setattr(layout, "SCHEMA", place)
    for read in (
        regular,
        file_hash,
        read_timings,
        lambda _: layout._against_schema({}),
        lambda _: judge.read_claims(tmp_path),
        lambda _: citation(tmp_path),
        lambda _: write_whole(tmp_path / "lock.json", ""),
    ):
        with pytest.raises(OSError, match=f"a {kind} lies where a file belongs; move it away"):
            read(place)


@pytest.mark.parametrize("text", ["", "[1, 2]", "title: a", "title: [", "\udcff"])
def test_a_damaged_citation_is_told_in_one_line(tmp_path: Path, text: str) -> None:
    (tmp_path / CITATION).write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(OSError, match="damaged; take it from the repository again"):
        citation(tmp_path)


def test_a_file_a_link_to_one_and_nothing_may_be_opened(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "link").symlink_to("file")
    for name in ("file", "link", "none", "none/below"):
        assert regular(tmp_path / name) == tmp_path / name


@pytest.mark.parametrize(
    ("made", "words"),
    [
        ({"data/smoke": Path.touch}, "a file lies where a folder belongs"),
        ({"data": Path.touch}, "a file lies where a folder belongs"),
        ({"data/smoke/a.h5": Path.mkdir}, "a folder lies where a file belongs"),
        ({"data/smoke/a.h5": os.mkfifo}, "a pipe lies where a file belongs"),
        ({"data/smoke/a.h5": lambda path: path.symlink_to("b.h5")}, "a link lies where a file belongs"),
        ({"data/smoke": lambda path: path.symlink_to("..")}, "a link lies where a folder belongs"),
    ],
)
def test_a_file_is_written_below_folders_of_the_project_only(
    tmp_path: Path, made: dict[str, Callable[[Path], object]], words: str
) -> None:
    place = tmp_path / "data/smoke/a.h5"
    for path, make in made.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        require_place(place, tmp_path)
        make(tmp_path / path)
    with pytest.raises(OSError, match=words):
        require_place(place, tmp_path)


def test_the_first_folder_may_lie_on_another_disk(tmp_path: Path) -> None:
    (tmp_path / "disk/smoke").mkdir(parents=True)
    (tmp_path / "data").symlink_to("disk")
    place = tmp_path / "data/smoke/a.h5"
    assert require_place(place, tmp_path) == place


def test_a_file_moves_whole_to_another_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Which is where nothing can be renamed to, but for what lies there already."""
    source, target = tmp_path / "here/a.h5", tmp_path / "there/a.h5"
    for path in (source, target):
        path.parent.mkdir()
        path.write_text(str(path))
    rename, seen = Path.replace, []

    def on_one_disk(old: Path, new: Path) -> Path:
        if old.parent != new.parent:
            raise OSError(errno.EXDEV, "Invalid cross-device link", str(old), None, str(new))
        seen.append((old.read_text(), new.read_text()))
        return rename(old, new)

    monkeypatch.setattr(Path, "replace", on_one_disk)
    move(source, target)
    assert seen == [(str(source), str(target))]
    assert target.read_text() == str(source)
    assert [path.name for path in tmp_path.rglob("*.*")] == ["a.h5"]


@pytest.mark.parametrize("kind", ["link", "pipe", "file", "folder"])
@pytest.mark.parametrize(
    "path",
    [
        "data/smoke",
        "data/smoke/lock.json",
        "data/smoke/lock.tmp",
        "data/smoke/fig03/paper.h5",
        "figures/smoke",
        "figures/smoke/fig03.pdf",
        "figures/smoke/fig03.pdf.tmp",
        "build/replaced",
        "build/replaced/data/smoke/fig03/paper.h5",
        "build/partial/smoke",
        "build/costs/smoke/fig03/paper.json",
        "build/logs/smoke/fig03/paper.log",
        "build/logs/smoke/fig03.log",
        "build/benchmarks",
    ],
)
def test_nothing_is_moved_where_a_job_could_not_write(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str, kind: str
) -> None:
    for module in (repository, stale):
        monkeypatch.setattr(module, "ROOT", tmp_path)
    product = tmp_path / "data/smoke/fig03/equal.h5"
    product.parent.mkdir(parents=True)
    product.touch()
    place = tmp_path / path
    place.parent.mkdir(parents=True, exist_ok=True)
    if place.is_dir():
        place.rename(tmp_path / "elsewhere")
    {**OTHERS, "file": Path.touch, "link": lambda place: place.symlink_to(tmp_path / "elsewhere")}[kind](
        place
    )
    chain, jobs = Chain("smoke", load_plan("smoke")), ["fig03/equal", "fig03/paper", "fig03"]
    if kind == ("file" if place.suffix else "folder"):
        stale.require_places(chain, jobs)
        return
    with pytest.raises(OSError, match=f"a {kind} lies where a .* belongs; move it away") as caught:
        stale.prepare(chain, jobs, fresh=True)
    assert caught.value.filename == str(place)
    assert product.exists() or (tmp_path / "elsewhere/fig03/equal.h5").exists()

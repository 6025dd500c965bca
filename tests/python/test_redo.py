"""Criteria for equal products of a job: the same bytes, equality up to rounding, or agreement within errors."""

import errno
import os
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest

from tests.python.conftest import Program
from workflow.lib import style
from workflow.lib.plan import outputs_of
from workflow.provenance import audit, redo, verify
from workflow.provenance.job import Job
from workflow.provenance.likeness import alike
from workflow.provenance.redo import SIGNIFICANCE, RedoError, disagreement, redrawn, same_bytes
from workflow.provenance.repository import machine

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


def scaled_error(mu: h5py.Group) -> None:
    mu["mean"][...] *= 50
    mu["standard_error"][...] = 1e9


@pytest.mark.parametrize(
    "forge",
    [
        scaled_error,
        lambda mu: mu["mean"].write_direct(np.array(np.nan)),
        lambda mu: mu["mean"].attrs.create("units", np.bytes_(b"length")),
    ],
)
def test_what_is_no_such_quantity_does_not(persistence: Program, tmp_path: Path, forge: Callable) -> None:
    paths = [tmp_path / "one.h5", tmp_path / "other.h5"]
    for seed, path in enumerate(paths):
        persistence(seed=seed, output=path, **ENOUGH)
    assert disagreement(*paths)[1] > SIGNIFICANCE
    with h5py.File(paths[1], "r+") as file:
        forge(file["results/mu"])
    assert disagreement(*paths)[1] == 0


@pytest.mark.parametrize(
    ("text", "agrees"),
    [
        ("# title\na,b\n1,2.0000000001\n", True),
        ("# title\na,b\n1,2.00001\n", False),
        ("# title\na,c\n1,2\n", False),
        ("# title\na,b\n", False),
        ("# other\na,b\n1,2.0\n", False),
        ("# title\na,b\n1,2.0 # remark\n", False),
        ("# title\na,b\n1,2,3,4\n1\n", False),
        ("\0", False),
    ],
)
def test_tables_agree_but_for_rounding(tmp_path: Path, text: str, agrees: bool) -> None:
    one, other = tmp_path / "one.csv", tmp_path / "other.csv"
    one.write_text("# title\na,b\n1,2.0\n")
    other.write_text(text)
    assert alike(one, other) is agrees


def picture(stem: Path, title: str = "title", y: tuple[float, ...] = (1, 2, 3), label: str = "x") -> None:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    axes.errorbar([1, 2, 3], y, 0.1, marker="o", **style.POINTS)
    axes.set_xlabel(label)
    for kind, day in (("pdf", {"CreationDate": None}), ("svg", {"Date": None}), ("png", {})):
        figure.savefig(stem.with_suffix(f".{kind}"), metadata={"Title": title, **day})
    plt.close(figure)


@pytest.mark.parametrize("kind", ["pdf", "svg", "png"])
@pytest.mark.parametrize(
    ("changes", "agrees"),
    [
        ({"y": (1, 2.0000000001, 3)}, True),
        ({"y": (1, 2.05, 3)}, False),
        ({"label": "t"}, False),
        ({"title": "other"}, False),
    ],
)
def test_pictures_agree_but_for_rounding(tmp_path: Path, kind: str, changes: dict, agrees: bool) -> None:
    style.apply()
    picture(tmp_path / "one")
    picture(tmp_path / "other", **changes)
    assert alike(tmp_path / f"one.{kind}", tmp_path / f"other.{kind}") is agrees


@pytest.mark.parametrize("kind", ["pdf", "svg", "png"])
def test_what_is_no_picture_agrees_with_none(tmp_path: Path, kind: str) -> None:
    style.apply()
    picture(tmp_path / "one")
    whole = tmp_path / f"one.{kind}"
    for name, content in {"empty": b"", "half": whole.read_bytes()[: whole.stat().st_size // 2]}.items():
        broken = tmp_path / f"{name}.{kind}"
        broken.write_bytes(content)
        assert not alike(whole, broken)


def test_a_word_of_a_style_sheet_is_no_rounding(tmp_path: Path) -> None:
    style.apply()
    picture(tmp_path / "one")
    text = (tmp_path / "one.svg").read_text()
    (tmp_path / "other.svg").write_text(text.replace("<!DOCTYPE", '<?xml-stylesheet href="x.css"?><!DOCTYPE'))
    assert not alike(tmp_path / "one.svg", tmp_path / "other.svg")


@pytest.mark.parametrize(
    ("place", "number", "differing"),
    [
        (machine(), "2.0000000001", {"a.csv": False}),
        ("elsewhere", "2.0000000001", {"a.csv": True}),
        ("elsewhere", "2.00001", {"a.csv": False}),
    ],
)
def test_rounding_explains_other_bytes_elsewhere_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str, number: str, differing: dict[str, bool]
) -> None:
    files = {"a.csv": ("a\n2.0\n", f"a\n{number}\n"), "a.svg": ("same", "same")}
    for name, (old, new) in files.items():
        (tmp_path / name).write_text(old)
        (tmp_path / f"again_{name}").write_text(new)
    monkeypatch.setattr(redo, "ROOT", tmp_path)
    monkeypatch.setattr(redo, "draw", lambda *_: {name: tmp_path / f"again_{name}" for name in files})
    assert redrawn(Job("", {}, {}, {}, None, None, place, 0, {}), tmp_path) == differing


@pytest.mark.parametrize(
    ("tool", "inputs", "words"),
    [
        ("workflow/lib/plan.py", {"workflow/lib/plan.py": ""}, "is no script of a figure"),
        ("workflow/figures/fig05.py", {}, "is no script of a figure"),
        ("workflow/figures/fig05.py", {"workflow/figures/fig05.py": "0"}, "is not what it was drawn from"),
        (
            "workflow/figures/fig05.py",
            {"../secret": "0", "workflow/figures/fig05.py": "0"},
            "is no path below the project",
        ),
        (
            "workflow/figures/fig05.py",
            {"data/none.h5": "0", "workflow/figures/fig05.py": "0"},
            "data/none.h5 is missing",
        ),
    ],
)
def test_only_what_the_lock_names_is_drawn(tmp_path: Path, tool: str, inputs: dict, words: str) -> None:
    job = Job(tool, {"configuration": ""}, {}, {}, None, None, "", 0, {}, inputs=inputs)
    with pytest.raises(RedoError, match=words):
        redrawn(job, tmp_path)


@pytest.mark.parametrize(
    ("number", "told"), [(errno.EFBIG, False), (errno.ENOSPC, False), (errno.ENOENT, True)]
)
def test_what_the_machine_has_no_room_for_is_no_fault_of_a_product(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, number: int, told: bool
) -> None:
    """Neither the audit nor a verification says so of it; a file that is missing is told of."""

    def fail(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    drawing = SimpleNamespace(outputs=dict.fromkeys(outputs_of("smoke", "fig05"), ""), is_drawing=True)
    lock = SimpleNamespace(quality="smoke", jobs={"fig05": drawing})
    monkeypatch.setattr(Path, "is_file", lambda _: True)
    for module in (audit, verify):
        monkeypatch.setattr(module, "redrawn", fail)
    chain = SimpleNamespace(quality="smoke", lock=lock)
    if told:
        (link,) = audit.contradictions(chain, "fig05", tmp_path / "a")
        assert "cannot be drawn again" in link.message
        assert verify.verdict_on(lock, "fig05", None, tmp_path)[0] is False
        return
    with pytest.raises(OSError, match=os.strerror(number)):
        audit.contradictions(chain, "fig05", tmp_path / "a")
    with pytest.raises(OSError, match=os.strerror(number)):
        verify.verdict_on(lock, "fig05", None, tmp_path)

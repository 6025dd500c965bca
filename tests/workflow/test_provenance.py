"""What a product was made from, whether it can be made again, and what is known of every panel."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import h5py
import pytest

from tests.workflow.conftest import Clone, append, replace
from tests.workflow.tampering import (
    LOCK,
    PICTURE,
    PROGRAM,
    both,
    in_place_of,
    other_machine,
    paint_red,
    relock,
    run_module,
    state_executable,
    tampered,
)
from workflow.lib.parents import file_hash
from workflow.lib.plan import load_plan

__all__ = ["tampered"]  # a fixture

FIGURE = "figures/smoke/fig03"


@pytest.mark.parametrize("kind", ["pdf", "png", "svg", "csv"])
def test_copy_elsewhere_tells_the_whole_chain(clean: Clone, tmp_path: Path, kind: str) -> None:
    copied = shutil.copyfile(clean.folder / f"{FIGURE}.{kind}", tmp_path / f"a copy.{kind}")
    told = clean.make("provenance", f"FILE={copied}", "FULL=yes").stdout
    identity = json.loads((clean.folder / "build/id/boltzmann.json").read_text())
    data = clean.folder / "data/smoke/fig03/paper.h5"
    wanted = [file_hash(copied), identity["build_id"], identity["source_hash"], file_hash(data)]
    wanted += [file_hash(clean.folder / path) for path in ("requirements.lock", "workflow/figures/fig03.py")]
    wanted += [file_hash(clean.folder / f"cpp/{path}") for path in identity["sources"]]
    assert all(digest[:16] in told for digest in wanted)
    for word in ("panel fig03 at quality smoke", "seed 0", "numpy==", identity["compiler"], "parameters"):
        assert word in told
    assert "not found" not in told


def test_run_tells_its_chain(clean: Clone) -> None:
    told = clean.make("provenance", "FILE=data/smoke/fig05/dense_sigma=-0.25.h5", "FULL=yes").stdout
    assert re.search(r"seed \d+, streams Philox", told)
    assert "program persistence" in told
    assert "cpp/model/collision.hpp" in told


def test_parents_that_have_changed_are_found_in_history(kept: Clone) -> None:
    for path in ("workflow/figures/fig03.py", "cpp/numerics/gmres.cpp", "requirements.lock"):
        append(path, "\n")(kept)
    replace("workflow/config/paper.yaml", "fig03:", "fig03x:")(kept)
    told = kept.make("provenance", f"FILE={FIGURE}.pdf").stdout
    assert told.count("as in commit") == 4
    assert "not found" not in told


def test_the_first_line_says_which_job_wrote_the_file(clean: Clone, tmp_path: Path) -> None:
    commit = json.loads((clean.folder / LOCK).read_text())["jobs"]["fig03"]["commit"]
    copied = shutil.copyfile(clean.folder / f"{FIGURE}.pdf", tmp_path / "copy.pdf")
    told = run_module(clean, "tree", str(copied), quality=None)
    assert told.returncode == 0
    lines = told.stdout.splitlines()
    assert lines[0] == f"copy.pdf is what job fig03 of quality smoke wrote (commit {commit[:16]}, clean)"
    assert len(lines) <= 25


def test_an_edited_copy_is_told_apart(clean: Clone, tmp_path: Path) -> None:
    copied = shutil.copyfile(clean.folder / f"{FIGURE}.csv", tmp_path / "copy.csv")
    with copied.open("a") as file:
        file.write("1,2\n")
    told = run_module(clean, "tree", str(copied), quality=None)
    assert told.returncode == 1
    first, second = told.stdout.splitlines()[:2]
    assert first == "copy.csv is not what any job here wrote: edited, damaged or made elsewhere"
    assert second == "What it says of itself, which nothing here confirms:"


def test_a_picture_of_the_gallery_is_known_by_the_commit_that_has_it(clean: Clone, tmp_path: Path) -> None:
    path = "docs/gallery/fig08.png"
    told = run_module(clean, "tree", path, quality=None)
    assert told.returncode == 0, told.stdout
    first, second = told.stdout.splitlines()[:2]
    assert re.fullmatch(
        rf"fig08\.png is what commit [0-9a-f]{{16}} has as {path}; no job here wrote it", first
    )
    assert second == "What it says of itself:"
    edited = shutil.copyfile(clean.folder / path, tmp_path / "fig08.png")
    with edited.open("ab") as file:
        file.write(b"\0")
    told = run_module(clean, "tree", str(edited), quality=None)
    assert told.returncode == 1
    assert "not what any job here wrote" in told.stdout


def test_a_damaged_lock_is_said_and_skipped(clean: Clone) -> None:
    lock = clean.folder / "data/deep/lock.json"
    lock.parent.mkdir()
    lock.write_text("{")
    try:
        told = run_module(clean, "tree", f"{FIGURE}.pdf", quality=None)
    finally:
        shutil.rmtree(lock.parent)
    assert told.returncode == 0
    assert "skipped data/deep/lock.json: data/deep/lock.json is damaged" in told.stdout


def test_hostile_words_do_not_command_the_terminal(clean: Clone, tmp_path: Path) -> None:
    text = (clean.folder / f"{FIGURE}.csv").read_text()
    hostile = tmp_path / "hostile.csv"
    hostile.write_text(text.replace('"panel": "fig03"', '"panel": "[red]\\u001b[2J"'))
    told = run_module(clean, "tree", str(hostile), quality=None)
    assert told.returncode == 1
    assert "\x1b" not in told.stdout
    assert "panel [red]" in told.stdout


def test_a_forged_result_is_refused(clean: Clone, tmp_path: Path) -> None:
    with h5py.File(tmp_path / "forged.h5", "w") as file:
        file.create_group("provenance").attrs.update({"format": "lorentz-gas", "format_version": 2})
        file["results"] = 1
    told = run_module(clean, "tree", str(tmp_path / "forged.h5"), quality=None)
    assert told.returncode == 1
    assert "not what any job here wrote" in told.stdout
    assert "Traceback" not in told.stdout


@pytest.mark.parametrize(("file", "words"), [("README.md", "names no parents"), ("none.pdf", "No such file")])
def test_files_without_parents_are_refused(clean: Clone, file: str, words: str) -> None:
    told = clean.make("provenance", f"FILE={file}")
    assert told.returncode != 0
    assert words in told.stdout
    assert "Traceback" not in told.stdout


@pytest.mark.long
def test_products_can_be_made_again_to_the_last_byte(kept: Clone) -> None:
    verified = kept.make("verify", "QUALITY=smoke", "PANEL=fig07", "SAMPLE=1")
    assert verified.returncode == 0, verified.stdout
    jobs = len(load_plan("smoke")["fig07"].runs) + 1
    assert verified.stdout.count("the same bytes") == jobs
    assert f"Looked at {jobs} of " in verified.stdout
    record = json.loads((kept.folder / "data/smoke/verification.json").read_text())
    assert record["fig07/all"]["same"] is True


def verify(clone: Clone, share: str = "0.1") -> subprocess.CompletedProcess:
    """By the order of the sample, a tenth of the panel is its drawing, for which no program is built."""
    return run_module(clone, "verify", "--panel", "fig03", "--sample", share)


@pytest.mark.long
def test_programs_are_built_from_their_sources_alone(tampered: Clone) -> None:
    """Without build, also where no program, hash or entry of the lock contradicts another. test_fresh_build is its short form."""
    both(append(PROGRAM, "x"), state_executable)(tampered)

    def forge(content: dict) -> None:
        content["jobs"]["fig03/paper"]["executable"] = file_hash(tampered.folder / PROGRAM)

    relock(forge)(tampered)
    build, hidden = tampered.folder / "build", tampered.folder / ".cache/hidden"
    build.rename(hidden)
    try:
        verified = verify(tampered, "1")
        assert not build.exists()
    finally:
        hidden.rename(build)
    assert verified.returncode == 1
    assert (
        "fig03/paper: the executable that made it is not what its sources give: boltzmann" in verified.stdout
    )
    assert "fig03/equal: the same bytes" in verified.stdout
    assert "Looked at 4 of " in verified.stdout
    record = json.loads((tampered.folder / "data/smoke/verification.json").read_text())
    assert {name: one["same"] for name, one in record.items()} == {
        "fig03": True,
        "fig03/equal": True,
        "fig03/exchange": True,
        "fig03/paper": False,
    }


def test_what_cannot_be_made_again_is_said(kept: Clone) -> None:
    append("figures/smoke/fig03.csv", "1,2\n")(kept)
    verified = verify(kept)
    assert verified.returncode == 1
    assert "fig03: other bytes in figures/smoke/fig03.csv" in verified.stdout


def test_a_picture_as_if_drawn_elsewhere_is_found(tampered: Clone) -> None:
    both(paint_red, relock(other_machine))(tampered)
    verified = verify(tampered)
    assert verified.returncode == 1
    assert f"fig03: other bytes in {PICTURE}" in verified.stdout


def test_verdicts_need_not_be_kept(kept: Clone) -> None:
    """Where they cannot be written, as in a copy that is read only."""
    blocked = kept.folder / "data/smoke/verification.tmp"
    blocked.mkdir()
    try:
        verified = verify(kept)
    finally:
        blocked.rmdir()
    assert verified.returncode == 0, verified.stdout
    assert "The verdicts are not kept: data/smoke/verification.json" in verified.stdout


def test_a_panel_that_is_unknown_or_no_file_is_refused(tampered: Clone) -> None:
    refused = run_module(tampered, "verify", "--panel", "figg03")
    assert refused.returncode == 2
    assert "fig03" in refused.stdout
    in_place_of(PICTURE, os.mkfifo)(tampered)
    verified = verify(tampered)
    assert verified.returncode == 1
    assert f"fig03: {PICTURE} is missing or not a file" in verified.stdout


def test_status_of_what_is_not_made(clean: Clone) -> None:
    told = clean.make("status", "QUALITY=deep", "SEED=7").stdout
    assert told.splitlines()[0] == (
        "Nothing is made: `make figures QUALITY=deep SEED=7` makes it, `make cost QUALITY=deep SEED=7` foretells what that takes"
    )


def test_status_says_what_is_stale_and_why(kept: Clone) -> None:
    def states() -> dict[str, str]:
        told = kept.make("status", "QUALITY=smoke").stdout
        rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in told.splitlines() if "│" in line]
        return {row[0]: row[1] for row in rows if row[0]}

    assert states().keys() >= load_plan("smoke").keys()
    assert set(states().values()) == {"fresh"}
    append("workflow/figures/fig06.py", "\n")(kept)
    replace(
        "workflow/config/quality/smoke.yaml", "fig07: {all: {replicas: 4}}", "fig07: {all: {replicas: 5}}"
    )(kept)
    stale = {panel: state for panel, state in states().items() if state != "fresh"}
    assert stale.keys() == {"fig06", "fig07"}
    assert stale["fig06"] == "workflow/figures/fig06.py changed"
    assert stale["fig07"] == "parameters changed: --replicas from 4 to 5"

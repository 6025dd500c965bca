"""Audit, status, provenance and verify of the small project."""

import hashlib
import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from tests.python.conftest import seal
from tests.workflow.conftest import ROOT, Project
from workflow.lib.load import load

Edit = Callable[[Project], object]
MU, OTHER_MU = "data/smoke/mu/all_sigma=0.5.*.h5", "data/smoke/mu/all_sigma=-0.5.*.h5"
FEW = "data/smoke/energy/few.*.h5"
RECORD, TABLE = "figures/smoke/mu.*.json", "figures/smoke/mu.csv"
LOADED = "from workflow.pipeline.load_panel import load_panel; print(*load_panel('mu', quality='smoke'))"


def edit_value(project: Project) -> None:
    with h5py.File(project.one(MU), "r+") as file:
        file["results/mu/mean"][...] *= 1.001


def remove(pattern: str) -> Edit:
    return lambda project: [path.unlink() for path in project.folder.glob(pattern)]


def write(path: str) -> Edit:
    return lambda project: (project.folder / path).write_text("mine")


def substitute(path: str, old: str, new: str) -> Edit:
    return lambda project: project.edit(path, lambda before: before.replace(old, new, 1))


def change_record(**changes: object) -> Edit:
    def edit(project: Project) -> None:
        path = project.one(RECORD)
        path.write_text(json.dumps(json.loads(path.read_text()) | changes))

    return edit


def change_all_tables(project: Project) -> None:
    """In the file, and its hash in the record."""
    content = project.one(TABLE).read_bytes() + b"9\n"
    project.one(TABLE).write_bytes(content)
    files = json.loads(project.one(RECORD).read_text())["files"]
    change_record(files=files | {"csv": hashlib.sha256(content).hexdigest()})(project)


def commit(project: Project) -> None:
    shutil.copy(ROOT / ".gitignore", project.folder)
    author = ("-c", "user.name=Nobody", "-c", "user.email=nobody@example.org")
    for words in (("init",), ("add", "--all"), (*author, "commit", "--message", "all")):
        project.run("git", *words)


# Edits; the command and its exit status; state, path (before the edits) and a part of the reason of every
# product that it names.
STATES: dict[str, tuple[list[Edit], str, int, list[tuple[str, str, str]]]] = {
    "a panel that has only lent its runs, and files of the user": (
        [
            remove("figures/smoke/mu.*"),
            write("data/smoke/mu/mine.h5"),
            write("figures/smoke/mine.pdf"),
        ],
        "audit",
        0,
        [],
    ),
    "results and files": (
        [edit_value, remove(OTHER_MU), write(TABLE), remove("figures/smoke/energy.svg")],
        "status",
        1,
        [
            ("edited", MU, "edited or damaged"),
            ("missing", OTHER_MU, ""),
            ("edited", TABLE, "differs from its hash"),
            ("missing", "figures/smoke/energy.svg", ""),
        ],
    ),
    "back to former sources": (
        [
            substitute("workflow/figures/mu.py", "A test", "Another"),
            lambda project: project.entry("figures"),
            substitute("workflow/figures/mu.py", "Another", "A test"),
        ],
        "status",
        1,
        [("stale", "figures/smoke/mu.pdf", "changed: workflow/figures/mu.py")],
    ),
    "sources and options": (
        [
            substitute("cpp/observables/persistence.cpp", "#include", "int x;\n#include"),
            substitute("workflow/config/paper.yaml", "particles-per-cell: 2", "particles-per-cell: 3"),
            substitute("workflow/figures/mu.py", "A test", "Another"),
        ],
        "status",
        1,
        [
            ("stale", OTHER_MU, "and 1 more: sources of persistence"),
            ("stale", FEW, "--particles-per-cell 2, planned is --particles-per-cell 3"),
            ("stale", "figures/smoke/mu.pdf", "workflow/figures/mu.py, results"),
            ("stale", "figures/smoke/energy.pdf", "results"),
        ],
    ),
    "a number in all files": (
        [change_all_tables],
        "audit PANEL=mu",
        1,
        [("edited", "figures/smoke/mu.csv", "gives other bytes")],
    ),
    "another renderer": (
        [change_all_tables, change_record(renderer="Python 2")],
        "audit PANEL=mu",
        3,
        [("not checked", "figures/smoke/mu.csv", "rendered with Python 2, this is Python 3")],
    ),
    "no figures": ([remove("figures/smoke/*")], "status", 3, []),
}


@pytest.mark.parametrize("case", STATES)
def test_audit_and_status_report_stale_edited_and_missing_files(project: Project, case: str) -> None:
    edits, command, status, named = STATES[case]
    paths = [str(project.one(path).relative_to(project.folder)) for _, path, _ in named]
    for edit in edits:
        edit(project)
    printed = project.entry(*command.split(), status=status)
    lines = [
        line
        for line in printed.splitlines()
        if line.startswith(("edited", "missing", "stale", "not checked"))
    ]
    assert len(lines) == len(named), printed
    for (state, _, reason), path in zip(named, paths, strict=True):
        assert any(line.startswith(f"{state}: {path}") and reason in line for line in lines), printed


def test_a_panel_beside_an_edited_file_is_no_success(project: Project) -> None:
    """Of its own, or of a result; other panels are."""
    write("figures/smoke/mu.csv")(project)
    printed = project.entry("figures", status=1)
    assert "figures/smoke/mu.csv" in printed
    assert "except mu" in printed
    assert "In figures/smoke" not in project.entry("panel", "PANEL=mu", status=1)
    assert "In figures/smoke: energy" in project.entry("panel", "PANEL=energy")
    edit_value(project)
    assert "In figures" not in project.entry("panel", "PANEL=energy", status=1)


def provenance(project: Project, file: Path, status: int = 0) -> str:
    return project.workflow("provenance", f"FILE={file}", status=status)


def test_where_a_copy_of_a_figure_comes_from(project: Project, tmp_path: Path) -> None:
    seeds = [load(project.one(path)).parameters["seed"] for path in (MU, OTHER_MU)]
    copy = Path(shutil.copy(project.folder / "figures/smoke/mu.png", tmp_path / "my talk.png"))
    printed = provenance(project, copy)
    assert printed.startswith(
        "unmodified, current\npanel mu, quality smoke: make panel PANEL=mu QUALITY=smoke\n"
    )
    assert all(f"--seed {seed}" in printed for seed in seeds)
    assert max(map(len, printed.splitlines())) <= 120
    substitute("workflow/lib/fit.py", '"""\n', '"""\n# mine\n')(project)
    assert provenance(project, copy).startswith("unmodified, stale: changed: workflow/lib\n")
    other = Path(shutil.copy(copy, tmp_path / "edited.png"))
    other.write_bytes(copy.read_bytes() + b"\n")
    substitute("cpp/observables/persistence.cpp", "#include", "int x;\n#include")(project)
    printed = provenance(project, other, status=1)
    assert printed.startswith("edited, stale: changed: workflow/lib, results\n")
    assert "sources of persistence differ here" in printed
    substitute("cpp/observables/persistence.cpp", "int x;\n#include", "#include")(project)
    project.entry("figures")
    assert "panel mu, quality smoke" in provenance(project, copy, status=3)


def test_a_read_only_project(project: Project) -> None:
    for path in (project.folder, *project.folder.rglob("*")):
        if not path.is_symlink():
            path.chmod(path.stat().st_mode & ~0o222)
    user = ("setpriv", "--bounding-set=-dac_override") if os.geteuid() == 0 else ()
    for words in (
        ("status", "QUALITY=smoke"),
        ("audit", "QUALITY=smoke"),
        ("provenance", f"FILE={project.one(MU)}"),
    ):
        project.run(*user, ".venv/bin/python", "-I", "-m", "workflow", *words)


def test_provenance_of_a_panel_that_is_not_here_suggests_no_command(project: Project) -> None:
    (project.folder / "theirs.csv").write_text("# panel theirs, quality smoke, identity 0123456789ab\n")
    printed = provenance(project, project.folder / "theirs.csv", status=3)
    assert printed.startswith("not checked: there is no panel theirs of quality smoke")
    assert "make " not in printed


def test_where_a_copy_of_a_result_comes_from(project: Project, tmp_path: Path) -> None:
    copy = Path(shutil.copy(project.one(MU), tmp_path / "mine.h5"))
    printed = provenance(project, copy)
    assert printed.startswith("unmodified, current\n")
    assert "panel mu, quality smoke: make panel PANEL=mu QUALITY=smoke\n" in printed
    assert load(copy).provenance["option_words"] in " ".join(printed.split())
    substitute("cpp/observables/persistence.cpp", "#include", "int x;\n#include")(project)
    assert provenance(project, copy).startswith("unmodified, stale: sources of persistence")
    edit_value(project)
    assert "edited" in provenance(project, project.one(MU), status=1)


@pytest.mark.parametrize("words", ["status", "audit", "figures DRY=yes"])
def test_reading_needs_no_program(project: Project, words: str) -> None:
    """As in a fresh clone. What computes needs the programs, and they validate their options."""
    copy = project.one(MU)
    printed = project.entry(*words.split()), provenance(project, copy)
    shutil.rmtree(project.folder / "build/bin")
    assert (project.entry(*words.split()), provenance(project, copy)) == printed
    loaded = project.run(".venv/bin/python", "-c", LOADED).stdout
    assert "all_sigma=0.5" in loaded
    copy.unlink()
    assert "run make build" in project.entry("figures", status=1)


def test_other_replicas_are_kept_apart(project: Project) -> None:
    before = project.products()
    for word in ("SEED=7", "REPLICAS=6", "ERROR=0.5"):
        project.entry("panel", "PANEL=mu", word)
    assert (project.folder / "figures/smoke_error=0.5/mu.csv").read_text().splitlines()[-2:] == ["64"] * 2
    (kept,) = project.folder.glob("data/smoke_seed=7/mu/all_sigma=0.5.*.h5")
    assert "panel mu, quality smoke_seed=7" in provenance(project, kept)
    assert project.products() == before


def test_verify_reruns_with_fresh_programs(project: Project) -> None:
    fresh = 'mkdir -p "$BUILD/bin"; cp build/bin/* "$BUILD/bin"\n'  # compiles nothing
    (project.folder / "workflow/pipeline/environment/build.sh").write_text(fresh)
    assert project.entry("verify", "SAMPLE=1").count(": equal\n") == 4
    edit_value(project)
    seal(project.one(MU))  # as of another program
    assert ": differs: mu\n" in project.entry("verify", "PANEL=mu", status=1)

"""What is made again after a change: exactly what it affects, whatever else happens to the files."""

import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Callable

import pytest

from tests.python.conftest import soon
from tests.workflow.conftest import Project

Edit = Callable[[Project], object]
RUNS = {"mu/all_sigma=-0.5", "mu/all_sigma=0.5", "energy/ageing", "energy/few"}
PANELS = {"mu", "energy"}
OF_MU = {"mu/all_sigma=-0.5", "mu/all_sigma=0.5", *PANELS}  # energy plots these runs, too


def text(path: str, old: str, new: str) -> Edit:
    return lambda project: project.edit(path, lambda before: before.replace(old, new))


def append(path: str, line: str) -> Edit:
    return lambda project: project.edit(path, lambda before: before + line)


def unimportant(project: Project) -> None:
    """Comments, files named like literals, files of editors, no memory of Snakemake, and other
    modification times in another order."""
    for path in ("cpp/statistics/fit.hpp", "workflow/pipeline/plan.py", "Snakefile", PAPER):
        append(path, "// x\n" if path.startswith("cpp") else "# x\n")(project)
    for name in ("log", "linear", "center", "data.csv"):
        (project.folder / name).write_text("x")
    (project.folder / "workflow/lib/fit.py~").write_text("x")
    (project.folder / "cpp/statistics/.#fit.cpp").symlink_to("of-emacs")
    shutil.rmtree(project.folder / ".snakemake")
    for number, path in enumerate(sorted(path for path in project.folder.rglob("*") if path.is_file())):
        os.utime(path, (1e9 - number, 1e9 - number), follow_symlinks=False)
    project.folder = project.folder.rename(project.folder.with_name("moved"))


PAPER, SMOKE = "workflow/config/paper.yaml", "workflow/config/quality/smoke.yaml"
CHANGES: dict[str, tuple[Edit, set[str]]] = {
    "line of C++ of a program": (
        append("cpp/observables/displacement.cpp", "int x;\n"),
        {"energy/ageing", "energy/few", "energy"},
    ),
    "flag of the compiler": (append("cpp/flags.cmake", "set(x)\n"), RUNS | PANELS),
    "option": (text(PAPER, "0.5]", "0.6]"), {"mu/all_sigma=0.6", *PANELS}),
    "number of replicas": (append(SMOKE, "  mu: {replicas: 5}\n"), OF_MU),
    "script": (append("workflow/figures/mu.py", "# x\n"), {"mu"}),
    "library": (append("workflow/lib/fit.py", "# x\n"), PANELS),
    "packages": (append("uv.lock", "# x\n"), PANELS),
    "nothing that matters": (unimportant, set()),
    "deleted result": (
        lambda project: project.one("data/smoke/energy/few.*.h5").unlink(),
        {"energy/few", "energy"},
    ),
    "deleted records": (
        lambda project: [path.unlink() for path in project.folder.glob("figures/smoke/*.json")],
        PANELS,
    ),
}


@pytest.mark.parametrize("change", CHANGES)
def test_exactly_what_is_affected_is_made_again(project: Project, change: str) -> None:
    edit, expected = CHANGES[change]
    edit(project)
    assert project.stale() == expected


def test_snakemake_makes_what_is_listed_and_a_dry_run_changes_no_file(project: Project) -> None:
    unimportant(project)
    append("workflow/figures/mu.py", "# x\n")(project)
    project.one("data/smoke/energy/few.*.h5").unlink()
    before = project.files("data", "figures", "build", "workflow/config")
    shown = project.snakemake("--dry-run")
    assert re.search(r"\bsimulate +1\b", shown)
    assert project.files("data", "figures", "build", "workflow/config") == before
    project.snakemake()
    assert project.stale() == set()


def test_equal_inputs_give_equal_bytes_in_any_environment(project: Project) -> None:
    before = project.products()
    for path in before:
        (project.folder / path).unlink()
    hostile = {"PYTHONHASHSEED": "7", "TZ": "Asia/Kathmandu", "MPLBACKEND": "TkAgg", "OMP_NUM_THREADS": "7"}
    hostile |= {"LC_ALL": "de_DE.UTF-8", "SOURCE_DATE_EPOCH": "1"}
    project.run(".venv/bin/python", "-I", "-m", "workflow", "figures", "QUALITY=smoke", **hostile)
    assert project.products() == before


def test_programs_are_compiled_if_they_do_not_state_the_hash_of_their_sources(project: Project) -> None:
    """Not after other times, a move or a comment; but one that does not start, whatever it contains."""
    (project.folder / "workflow/pipeline/environment/build.sh").write_text("echo compiled\n")
    unimportant(project)
    assert project.workflow("build") == ""
    build = (".venv/bin/python", "-m", "workflow", "build")
    assert project.run(*build, CXX="c++").stdout == "compiled\n"
    program = project.folder / "build/bin/displacement"
    content = program.read_bytes()
    program.unlink()
    program.write_bytes(content)  # not executable
    assert project.workflow("build").startswith("Compiling 1 program")
    append("cpp/statistics/fit.hpp", "int x;\n")(project)
    assert project.workflow("build").startswith("Compiling 2 programs")
    mistyped = project.workflow("panel", "PANEL=mo", status=2)  # nothing is compiled before
    assert mistyped == "mo is not a panel; choose one of mu, energy\n"


def test_a_program_that_does_not_compile_blocks_no_other(project: Project) -> None:
    """Nor rendering, which needs no compiler."""
    (project.folder / "workflow/pipeline/environment/build.sh").write_text("exit 1\n")
    (project.folder / "build/bin/displacement").unlink()
    (project.folder / "figures/smoke/mu.svg").unlink()
    line = "cpp/observables/displacement.cpp: not compiled"
    assert line not in project.entry("panel", "PANEL=mu")
    next(project.folder.glob("data/smoke/mu/*.h5")).unlink()
    assert line in project.entry("panel", "PANEL=mu")
    assert line in project.workflow("build", status=1)
    append("cpp/observables/displacement.cpp", "int x\n")(project)
    assert "run make build" in project.entry("panel", "PANEL=energy", status=1)


def test_a_wrong_result_is_refused_and_takes_no_other_panel_with_it(project: Project) -> None:
    """A result of another run; then a deleted file, and options in another order. test_load has the ways
    of damage."""
    before, wrong = project.products(), project.one("data/smoke/energy/few.*.h5")
    shutil.copy(project.one("data/smoke/mu/all_sigma=-0.5.*.h5"), wrong)
    for record in project.folder.glob("figures/smoke/*.json"):
        record.unlink()
    printed = project.entry("figures", status=1)
    assert "mu: rendered" in printed
    assert "remove it and make it again" in printed
    assert project.stale() == {"energy"}
    wrong.unlink()
    (project.folder / "figures/smoke/energy.png").unlink()
    text(PAPER, "cells: 4, particles-per-cell: 4, r", "particles-per-cell: 4, cells: 4, r")(project)
    project.entry("figures")
    assert project.products() == before


def test_a_mistake_in_a_script_keeps_the_former_files_and_is_one_line(project: Project) -> None:
    """Detected mistakes: Snakemake deletes the files before the script starts; the reason of a former
    failure."""
    before = project.files("figures/smoke")
    append("workflow/figures/mu.py", "x = 1 / 0\n")(project)
    number = len((project.folder / "workflow/figures/mu.py").read_text().splitlines())
    printed = project.entry("figures", status=1)
    assert f"mu: workflow/figures/mu.py:{number}: ZeroDivisionError: division by zero" in printed
    assert "1 other panel is made" in printed
    assert project.files("figures/smoke") == before
    text("workflow/figures/mu.py", "1 / 0", "1")(project)
    append("Snakefile", "x = 1 / 0\n")(project)
    printed = project.entry("figures", status=1)
    assert "mu.py:" not in printed
    assert "build/logs/snakemake.log" in printed


def test_the_study_may_be_missing(project: Project) -> None:
    """As of a colleague who needs one figure."""
    shutil.rmtree(project.folder / "workflow/study", ignore_errors=True)  # or is
    append("workflow/figures/mu.py", "# x\n")(project)
    project.entry("figures")
    project.entry("status")
    project.snakemake()
    assert "workflow/study" in project.entry("report", status=2)


def test_a_file_that_a_panel_declares_is_part_of_it(project: Project) -> None:
    (project.folder / "data/points.csv").write_text("1")
    text(PAPER, "  mu:\n", "  mu:\n    inputs: [data/points.csv]\n")(project)
    assert project.stale() == {"mu"}
    project.entry("figures")
    assert "\ndata/points.csv\n" in project.workflow("provenance", "FILE=figures/smoke/mu.png")
    with (project.folder / "data/points.csv").open("ab") as file:
        file.write(b"2")
    assert project.stale() == {"mu"}
    assert "changed: data/points.csv" in project.entry("status", status=1)
    (project.folder / "data/points.csv").unlink()
    assert "data/points.csv is not a file" in project.entry("status", status=2)


def test_panels_of_the_user_are_made_by_name_alone(project: Project) -> None:
    """Also with a module and a file of their own."""
    own = project.folder / "own"
    own.mkdir()
    (own / "helper.py").write_text("NUMBER = 3\n")
    (own / "panels.yaml").write_text("panels:\n  mine: {uses: [mu], inputs: [own/helper.py]}\n")
    project.one("figures/smoke/mu.csv").unlink()
    project.entry("figures")  # although there is no script yet
    assert "mine" in project.entry("status")
    assert "own/mine.py" in project.entry("panel", "PANEL=mine", status=2)
    shutil.copy(project.folder / "workflow/figures/mu.py", own / "mine.py")
    append("own/mine.py", "from own.helper import NUMBER\nx = NUMBER\n")(project)
    assert project.stale() == set()
    project.entry("panel", "PANEL=mine")
    (own / "helper.py").write_text("NUMBER = 4\n")
    printed = project.entry("status", status=1)
    assert "changed: own/helper.py" in printed
    assert [line for line in printed.splitlines() if line.endswith("makes stale and missing files")] == [
        "make panel PANEL=mine QUALITY=smoke makes stale and missing files"
    ]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_two_commands_exclude_each_other_and_a_stopped_one_resumes(
    project: Project, number: signal.Signals
) -> None:
    folder = project.folder / "data/smoke_replicas=1000/mu"
    planned = (project.folder / PAPER).read_text()
    text(PAPER, "time: 5}\n    series:\n      all", "time: 20000}\n    series:\n      all")(project)
    long = ("mu", "--config", "quality=smoke_replicas=1000")
    with (project.folder / "log.txt").open("w") as file:
        running = subprocess.Popen(
            [".venv/bin/snakemake", *long],
            cwd=project.folder,
            stdout=file,
            stderr=file,
            start_new_session=True,
        )
    soon(lambda: [*folder.glob("*.log")] or running.poll() is not None)
    (project.folder / PAPER).write_text(planned)
    if number == signal.SIGINT:
        assert "another command of make or Snakemake" in project.entry("figures", status=1)
        assert project.stale() == set()  # a dry run needs no lock
    else:
        time.sleep(1)
    assert running.poll() is None
    os.killpg(running.pid, number)
    running.wait()
    if number == signal.SIGKILL:
        project.entry("figures")  # the lock has ended with its process
    else:
        soon(lambda: [*folder.glob("*.checkpoint")])

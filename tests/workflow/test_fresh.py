"""What is made again after a change: exactly what it affects, whatever else happens to the files."""

import os
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from tests.workflow.conftest import Project

Edit = Callable[[Project], object]
RUNS = {"mu/all_sigma=-0.5", "mu/all_sigma=0.5", "energy/ageing", "energy/few"}
PANELS = {"mu", "energy"}


def text(path: str, old: str, new: str) -> Edit:
    return lambda project: project.edit(path, lambda before: before.replace(old, new))


def append(path: str, line: str) -> Edit:
    return lambda project: project.edit(path, lambda before: before + line)


def code(path: str, line: str) -> Edit:
    """Adds a line to a C++ source, and compiles."""

    def edit(project: Project) -> None:
        append(f"cpp/{path}", line)(project)
        project.rebuild()

    return edit


def times(project: Project) -> None:
    """Other modification times, in another order."""
    for number, path in enumerate(sorted(path for path in project.folder.rglob("*") if path.is_file())):
        os.utime(path, (1e9 - number, 1e9 - number), follow_symlinks=False)


def names_of_literals(project: Project) -> None:
    for name in ("log", "linear", "center", "data.csv"):
        (project.folder / name).write_text("x")


PAPER, SMOKE = "workflow/config/paper.yaml", "workflow/config/quality/smoke.yaml"
CHANGES: dict[str, tuple[Edit, set[str]]] = {
    "line of C++ that all share": (code("statistics/fit.hpp", "int x;\n"), RUNS | PANELS),
    "line of C++ of one program": (
        code("observables/ageing.cpp", "int x;\n"),
        {"energy/ageing", "energy/few", "energy"},
    ),
    "flag of the compiler": (code("flags.cmake", "set(x)\n"), RUNS | PANELS),
    "line of C++ of another program": (code("observables/displacement.cpp", "int x;\n"), set()),
    "comment in C++": (code("statistics/fit.hpp", "// x\n\n/* y\n z */\n"), set()),
    "option": (text(PAPER, "0.5]", "0.6]"), {"mu/all_sigma=0.6", "mu", "energy"}),
    "polynomial": (text(PAPER, "1N", "2N"), {"mu/all_sigma=-0.5", "mu/all_sigma=0.5", "mu", "energy"}),
    "order of the options": (
        text(PAPER, "cells: 4, particles-per-cell: 4, r", "particles-per-cell: 4, cells: 4, r"),
        set(),
    ),
    "number of replicas": (append(SMOKE, "  mu: {replicas: 5}\n"), {
        "mu/all_sigma=-0.5", "mu/all_sigma=0.5", "mu", "energy",
    }),
    "script": (append("workflow/figures/mu.py", "# x\n"), {"mu"}),
    "library": (append("workflow/lib/fit.py", "# x\n"), PANELS),
    "packages": (append("uv.lock", "# x\n"), PANELS),
    "plan, rules and comments of the configuration": (
        lambda project: [append(path, "# x\n")(project) for path in ("workflow/plan.py", "Snakefile", PAPER)],
        set(),
    ),
    "files named like literals": (names_of_literals, set()),
    "modification times": (times, set()),
    "no memory of Snakemake": (lambda project: shutil.rmtree(project.folder / ".snakemake"), set()),
    "another folder": (lambda project: project.folder.rename(project.folder.with_name("moved")), set()),
    "deleted result": (lambda project: project.one("data/smoke/energy/few.*.h5").unlink(), {
        "energy/few", "energy",
    }),
    "deleted store": (lambda project: shutil.rmtree(project.folder / "build/figures"), PANELS),
}  # fmt: skip


@pytest.mark.parametrize("change", CHANGES)
def test_exactly_what_is_affected_is_made_again(project: Project, change: str) -> None:
    edit, expected = CHANGES[change]
    edit(project)
    if change == "another folder":
        project.folder = project.folder.with_name("moved")
    before = project.files(".")
    assert project.stale() == expected
    log = {path for path in project.files(".") if path.startswith(".snakemake") or "__pycache__" in path}
    assert {path: content for path, content in project.files(".").items() if path not in log} == {
        path: content for path, content in before.items() if path not in log
    }  # a dry run changes no file


def test_edited_and_deleted_copies_are_restored(project: Project) -> None:
    before = project.products()
    (project.folder / "figures/smoke/mu.csv").write_text("edited")
    (project.folder / "figures/smoke/energy.png").unlink()
    project.entry("figures")
    assert project.products() == before


def test_equal_inputs_give_equal_bytes_in_any_environment(project: Project) -> None:
    before = project.products()
    for path in before:
        (project.folder / path).unlink()
    hostile = {"PYTHONHASHSEED": "7", "TZ": "Asia/Kathmandu", "MPLBACKEND": "TkAgg", "OMP_NUM_THREADS": "7"}
    project.snakemake("figures", **hostile, LC_ALL="de_DE.UTF-8", SOURCE_DATE_EPOCH="1")
    assert project.products() == before


def test_a_program_that_is_older_than_its_sources_is_refused(project: Project) -> None:
    append("cpp/statistics/fit.hpp", "int x;\n")(project)
    assert "is not built from the present sources: run make build" in project.entry("figures", status=1)
    for former in (project.folder / "build/bin").iterdir():
        former.unlink()
    assert "is missing: run make build" in project.entry("figures", status=1)


def exchanged(project: Project) -> None:
    one, other = sorted((project.folder / "data/smoke/mu").glob("*.h5"))
    shutil.copy(one, other)


def edited(project: Project) -> None:
    with h5py.File(project.one("data/smoke/mu/all_sigma=0.5.*.h5"), "r+") as file:
        file["results/mu/mean"][...] *= 1.001


def truncated(project: Project) -> None:
    path = project.one("data/smoke/mu/all_sigma=0.5.*.h5")
    path.write_bytes(path.read_bytes()[:-100])


@pytest.mark.parametrize("damage", [exchanged, edited, truncated])
def test_a_wrong_result_is_refused_and_the_same_command_makes_it_again(
    project: Project, damage: Edit
) -> None:
    before = project.products()
    damage(project)
    shutil.rmtree(project.folder / "build/figures")
    assert "the same command makes it again" in project.entry("figures", status=1)
    project.entry("figures")
    refused = project.one("data/smoke/mu/*.refused")
    refused.unlink()
    assert project.products() == before


def test_results_of_a_program_that_was_exchanged_meanwhile_are_refused(project: Project) -> None:
    """The sources are edited, compiled and restored while Snakemake runs: wrong values would get right names."""
    shutil.rmtree(project.folder / "data/smoke")
    append("cpp/statistics/fit.hpp", "int x;\n")(project)
    project.rebuild()
    other = {path.name: path.read_bytes() for path in (project.folder / "build/bin").iterdir()}
    project.edit("cpp/statistics/fit.hpp", lambda before: before.removesuffix("int x;\n"))
    project.rebuild()
    hook = "onstart:\n    [Path('build/bin', name).write_bytes(Path('other', name).read_bytes()) for name in os.listdir('other')]\n"
    project.edit("Snakefile", lambda before: before.replace("onstart:\n", hook))
    for name, content in other.items():
        (project.folder / "other").mkdir(exist_ok=True)
        (project.folder / "other" / name).write_bytes(content)
    printed = project.entry("figures", status=1)
    assert "its content is that of another result" in printed


def test_a_script_that_imports_another_is_refused(project: Project) -> None:
    text("workflow/figures/mu.py", "import pandas as pd\n", "import pandas as pd\nfrom workflow.figures import energy\n")(project)  # fmt: skip
    assert "imports the script workflow.figures.energy" in project.entry("figures", status=1)


LONG = ("--config", "quality=smoke_replicas=300000", "panel=mu", "--", "panel")


def until(condition: Callable[[], object]) -> None:
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def start(project: Project, *command: str) -> subprocess.Popen[bytes]:
    """Starts a command that takes long, in a process group of its own, and waits for its first run."""
    log, runs = project.folder / "log.txt", len([*(project.folder / "data/smoke/mu").glob("*.log")])
    with log.open("w") as file:
        running = subprocess.Popen(
            command, cwd=project.folder, stdout=file, stderr=file, start_new_session=True
        )
    until(
        lambda: len([*(project.folder / "data/smoke/mu").glob("*.log")]) > runs or running.poll() is not None
    )
    assert running.poll() is None, log.read_text()
    return running


@pytest.mark.parametrize("first", [".venv/bin/snakemake", ".venv/bin/python"])
def test_two_commands_at_once_exclude_each_other(project: Project, first: str) -> None:
    entry = ("-m", "workflow", "panel", "PANEL=mu", "QUALITY=smoke", "REPLICAS=300000")
    running = start(project, first, *(LONG if first.endswith("snakemake") else entry))
    try:
        assert "Another command is making products" in project.entry("figures", status=1)
        assert "Another command is making products" in project.snakemake("figures", status=1)
        assert project.stale() == set()  # a dry run needs no lock
    finally:
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()
    project.entry("figures")  # the lock has ended with its process


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_stopped_command_resumes(project: Project, number: signal.Signals) -> None:
    running = start(project, ".venv/bin/snakemake", *LONG)
    time.sleep(1)
    os.killpg(running.pid, number)
    running.wait()
    folder = project.folder / "data/smoke/mu"
    until(lambda: [*folder.glob("*.checkpoint")])
    assert Path(project.folder, "figures/smoke_replicas=300000").is_dir()  # a plan from its start

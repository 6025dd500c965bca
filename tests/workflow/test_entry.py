"""The entry: mistyped options get one line and exit status 2, and make passes its options."""

import shutil
import sys
from pathlib import Path

import pytest

from tests.workflow.conftest import ROOT, Project, plain


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ("panel PANLE=fig05", "PANLE is not an option; did you mean PANEL?"),
        ("panel PANEL=fig5", "fig5 is not a panel; did you mean fig05?"),
        ("panel PANEL=fig05,fig06", "fig05,fig06 is not a panel; did you mean fig05 fig06?"),
        ("panel PANEL=fig04", "fig04 is not a panel; did you mean fig04a or fig04b?"),
        ("figures PANEL=fig03", "PANEL has no effect on figures"),
        ("figures JOBS=0", "JOBS=0 is invalid; give a whole number, at least 1"),
        ("figures PROFILE=slurm", "sbatch is not in PATH"),
    ],
)  # fmt: skip
def test_a_mistyped_option_gets_a_line(tmp_path: Path, words: str, line: str) -> None:
    printed = Project(ROOT).workflow(*words.split(), status=2, path=str(tmp_path))
    assert printed.startswith(line)
    assert len(printed.splitlines()) == 1


def test_make_passes_its_options(project: Project) -> None:
    """Also those with spaces and quotes."""
    make = ("make", "panel", "QUALITY=smoke")
    printed = project.run(*make, "PANEL=mu it's", status=2, PYTHONPATH="/nonexistent").stdout
    assert printed.splitlines()[0] == "it's is not a panel; choose one of mu, energy"
    printed = project.run(*make, "PANEL=mu energy").stdout
    assert printed.splitlines()[-1] == "In figures/smoke: mu energy.pdf and .png .svg .csv"


@pytest.mark.parametrize(
    ("words", "option"),
    [("figures", {"DRY": "yes"}), ("status", {"QUALITY": "smoke"}), ("panel PANEL=mu", {"SEED": "7"})],
)  # fmt: skip
def test_an_option_from_the_environment_is_refused(
    project: Project, words: str, option: dict[str, str]
) -> None:
    """With the command that has its effect. Nothing is made or removed."""
    before = project.products()
    (name, value) = next(iter(option.items()))
    done = project.run("make", *words.split(), status=2, **option)
    assert f"{name}={value}" in done.stdout
    assert project.products() == before


def test_reading_keeps_an_environment_that_does_not_run(tmp_path: Path) -> None:
    """As on a node or in a container without its interpreter."""
    for name in ("Makefile", "workflow"):
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, tmp_path / name)
    packages = tmp_path / ".venv/lib/python3/site-packages/own.py"
    packages.parent.mkdir(parents=True)
    packages.touch()
    (tmp_path / ".venv/bin").mkdir()
    (tmp_path / ".venv/bin/python").symlink_to("/nonexistent/python3")
    for target in ("status", "audit", "provenance", "verify"):
        done = Project(tmp_path).run("make", target, status=2)
        assert "/nonexistent/python3" in done.stdout
        assert "make setup" in done.stdout
    assert packages.exists()
    assert not (tmp_path / ".cache").exists()


def test_a_copied_build_is_refused_by_ninja(tmp_path: Path) -> None:
    """As it would compile the sources of the original."""
    ninja = ("ninja", "-C", shutil.copytree(ROOT / "build", tmp_path / "build", symlinks=True))
    done = Project(tmp_path).run(*ninja, "persistence", status=1)
    assert "make build" in done.stdout


def test_a_complete_environment_needs_no_uv(tmp_path: Path) -> None:
    """As in a copy without .cache, offline. Other packages in uv.lock, or other groups, are installed."""
    scripts = tmp_path / "workflow/pipeline/environment"
    scripts.mkdir(parents=True)
    shutil.copy(ROOT / "workflow/pipeline/environment/setup.sh", scripts)
    (scripts / "system_packages.sh").touch()
    (tmp_path / "uv.lock").touch()
    project, uv = Project(tmp_path), tmp_path / "bin/uv"
    project.run(sys.executable, "-m", "venv", "--without-pip", ".venv")
    uv.parent.mkdir()
    uv.write_text("#!/bin/bash\necho uv 99.0.0\necho called >&2\n")
    uv.chmod(0o755)

    def installs(*groups: str) -> bool:
        path = f"{uv.parent}:{plain()['PATH']}"
        return "called" in project.run("bash", scripts / "setup.sh", *groups, PATH=path).stdout

    assert [installs(), installs(), installs("dev"), installs("dev"), installs()] == [
        True,
        False,
        True,
        False,
        False,
    ]
    (tmp_path / "uv.lock").write_text("other")
    assert installs()


def test_another_folder_is_refused(project: Project, tmp_path: Path) -> None:
    """As results and figures would be written there."""
    other = tmp_path / "other"
    other.mkdir()
    done = project.run("env", "-C", other, project.folder / ".venv/bin/python", "-m", "snakemake", "-s",
                       project.folder / "Snakefile", "-n", status=1)  # fmt: skip
    assert str(project.folder) in done.stdout
    assert not {path.name for path in other.iterdir()} - {".snakemake"}

"""The entry: mistyped options get one line and exit status 2, and make passes its options."""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.workflow.conftest import ROOT, Project, without_installation
from workflow.__main__ import words_of_make


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ("figure", "figure is not a target; did you mean figures?"),
        ("panel PANLE=fig05", "PANLE is not an option; did you mean PANEL?"),
        ("panel", "PANEL is missing; try make panel PANEL=fig05"),
        ("panel PANEL=fig5", "fig5 is not a panel; did you mean fig05?"),
        ("figures PANEL=fig03", "PANEL has no effect on figures"),
        ("figures FRESH=0", "FRESH=0 is invalid; give yes, or leave it out"),
        ("figures JOBS=0", "JOBS=0 is invalid; give a whole number, at least 1"),
        ("figures PROFILE=slrm", "slrm is not a profile; did you mean slurm?"),
        ("figures QUALITY=fast", "fast is not a quality; choose one of smoke, standard, paper, deep"),
        ("figures REPLICAS=-1", "REPLICAS=-1 is invalid; give a whole number, at least 1"),
        ("figures PROFILE=slurm", "sbatch is not in PATH"),
    ],
)  # fmt: skip
def test_a_mistyped_option_gets_a_line(tmp_path: Path, words: str, line: str) -> None:
    printed = Project(ROOT).workflow(*words.split(), status=2, path=str(tmp_path))
    assert printed.startswith(line)
    assert len(printed.splitlines()) == 1


def test_words_of_make() -> None:
    assert words_of_make("") == []
    assert words_of_make("kw -j2 --jobserver-auth=3,4 -- PANEL=a\\ b QUALITY=smoke") == [
        "PANEL=a b",
        "QUALITY=smoke",
    ]
    assert words_of_make('-- FILE=it\'s\\ "x"') == ['FILE=it\'s "x"']


def test_make_passes_its_options(project: Project) -> None:
    """Also those with spaces and quotes; the variables of the caller's shell are no options."""
    without_installation(project)
    make = ("make", "panel", "QUALITY=smoke")
    printed = project.run(*make, "PANEL=mu it's", status=2, ERROR="0.1", PYTHONPATH="/nonexistent").stdout
    assert printed.splitlines()[0] == "it's is not a panel; choose one of mu, energy"
    printed = project.run(*make, "PANEL=mu energy").stdout
    assert printed.splitlines()[-1] == "In figures/smoke: mu energy.pdf and .png .svg .csv"


def test_missing_system_packages_are_named_for_those_without_rights(tmp_path: Path) -> None:
    for tool in ("bash", "comm", "printf", "sed", "sort", "tr"):
        (tmp_path / tool).symlink_to(shutil.which(tool) or "")
    for tool, printed in (("id", "1000"), ("dpkg-query", "installed g++\nconfig-files cmake")):
        (tmp_path / tool).write_text(f"#!/bin/bash\nprintf '{printed}\\n'\n")
        (tmp_path / tool).chmod(0o755)
    command = ["bash", ROOT / "workflow/environment/system_packages.sh"]
    done = subprocess.run(command, env={"PATH": str(tmp_path)}, capture_output=True, text=True, check=False)
    assert {"cmake", "ninja-build", "libhdf5-dev"} <= {*done.stderr.split()}
    assert "g++" not in done.stderr

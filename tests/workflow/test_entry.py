"""The entry: mistyped options get one line and exit status 2, and make passes its options."""

from pathlib import Path

import pytest

from tests.workflow.conftest import ROOT, Project


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ("panel PANLE=fig05", "PANLE is not an option; did you mean PANEL?"),
        ("panel PANEL=fig5", "fig5 is not a panel; did you mean fig05?"),
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
    """Also those with spaces and quotes; the variables of the caller's shell are no options."""
    make = ("make", "panel", "QUALITY=smoke")
    printed = project.run(*make, "PANEL=mu it's", status=2, ERROR="0.1", PYTHONPATH="/nonexistent").stdout
    assert printed.splitlines()[0] == "it's is not a panel; choose one of mu, energy"
    printed = project.run(*make, "PANEL=mu energy").stdout
    assert printed.splitlines()[-1] == "In figures/smoke: mu energy.pdf and .png .svg .csv"

"""The gallery is that of the results of the release, which are in git."""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.pipeline.plan import load_plan, runs_of

GALLERY = "docs/gallery"


@pytest.mark.long
def test_gallery_is_rendered_from_the_results_of_the_release(tmp_path: Path) -> None:
    """Detected mistakes: a number or verdict edited by hand; scripts, claims or configuration that were changed without the gallery."""
    plan = load_plan("paper")
    if missing := [path for path in runs_of(plan, plan, "paper") if not (ROOT / path).exists()]:
        pytest.skip(
            f"programs or configuration changed since the release: {missing[0]} and {len(missing) - 1} more"
        )
    project = tmp_path / "project"
    shutil.copytree(ROOT, project, ignore=shutil.ignore_patterns(".git", ".venv", ".snakemake", "build"))
    for name in ("bin", "describe"):
        shutil.copytree(ROOT / "build" / name, project / "build" / name)
    (project / ".venv").symlink_to(ROOT / ".venv")
    subprocess.run(
        [ROOT / ".venv/bin/python", "-m", "workflow", "gallery", "QUALITY=paper"], cwd=project, check=True
    )
    for name in ("README.md", "numbers.csv"):
        assert (project / GALLERY / name).read_bytes() == (ROOT / GALLERY / name).read_bytes(), name

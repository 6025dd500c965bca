"""The gallery is that of the results of the release, which are in git."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.claims import data as claims_data
from workflow.claims.data import Data
from workflow.claims.judge import judge_all
from workflow.pipeline.plan import RELEASE as QUALITY
from workflow.pipeline.plan import Run, load_plan, with_used
from workflow.report import write

GALLERY = ROOT / "docs/gallery"


def released(_quality: str, panel: str, run: Run) -> str:
    """The result of a run in git, also after a change of its program, which gives new results another identity."""
    names = Path(ROOT, "data", QUALITY, panel).glob(f"{run.name}.*.h5")
    (path,) = (path for path in names if path.name.removeprefix(f"{run.name}.").removesuffix(".h5").isalnum())
    return str(path.relative_to(ROOT))


@pytest.mark.long
def test_gallery_is_rendered_from_the_results_of_the_release(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Detected mistakes: a number, a verdict or a caption edited by hand; scripts, claims or configuration changed without the gallery."""
    plan = load_plan(QUALITY)
    for name, panel in plan.items():
        results = [released(QUALITY, used.name, run) for used in with_used(plan, name) for run in used.runs]
        command = [
            sys.executable,
            "-P",
            "-m",
            f"workflow.figures.{panel.script}",
            "--output",
            tmp_path / QUALITY / name,
        ]
        subprocess.run([*command, "--data", *results, "--reads", *panel.reads], cwd=ROOT, check=True)
    monkeypatch.setattr(claims_data, "data_path", released)
    monkeypatch.setattr(write, "stem_of", lambda _plan, name, _quality: tmp_path / QUALITY / name)
    data = Data(QUALITY, ROOT)
    judgements = judge_all(data)
    assert write.numbers_file(judgements) == (GALLERY / "numbers.csv").read_bytes()
    assert write.rendered(judgements, data, release=True) == (GALLERY / "README.md").read_bytes()

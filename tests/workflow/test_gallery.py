"""The gallery is that of the results of the release, which are in git."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.python.conftest import ROOT
from workflow.claims.judge import judge_all
from workflow.lib.identity import RELEASE as QUALITY
from workflow.lib.job import Job
from workflow.lib.save import reduced
from workflow.pipeline.plan import Run, load_plan, with_used
from workflow.report import planned, write

GALLERY = ROOT / "docs/gallery"


def released(_quality: str, panel: str, run: Run) -> str:
    """The result of a run in git, also after a change of its program, which gives new results another
    identity."""
    names = Path(ROOT, "data", QUALITY, panel).glob(f"{run.name}.*.h5")
    (path,) = (path for path in names if path.name.removeprefix(f"{run.name}.").removesuffix(".h5").isalnum())
    return str(path.relative_to(ROOT))


def pixels(picture: Path) -> np.ndarray:
    with Image.open(picture) as opened:
        return np.asarray(opened.convert("RGB"))


@pytest.mark.long
def test_gallery_is_rendered_from_the_results_of_the_release(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Detected mistakes: a number, a verdict, a caption or a picture edited by hand; scripts, claims or
    configuration changed without the gallery."""
    plan, folder = load_plan(QUALITY), tmp_path / QUALITY
    jobs = [
        Job(
            panel.script,
            str(folder / name),
            [released(QUALITY, used.name, run) for used in with_used(plan, name) for run in used.runs],
            [*panel.reads],
        )
        for name, panel in plan.items()
    ]
    command = [sys.executable, "-P", "-m", "workflow.lib.render"]
    subprocess.run([*command, *(job.json for job in jobs)], cwd=ROOT, check=True)
    monkeypatch.setattr(planned, "data_path", released)
    monkeypatch.setattr(write, "record_of", lambda _plan, name, _quality: next(folder.glob(f"{name}.*.json")))
    monkeypatch.setattr(write, "stem_of", lambda name, _quality: folder / name)
    data = planned.Planned(QUALITY, ROOT)
    judgements = judge_all(data)
    assert write.numbers_file(judgements) == (GALLERY / "numbers.csv").read_bytes()
    assert write.rendered(judgements, data, release=True) == (GALLERY / "README.md").read_bytes()
    for name in plan:
        (tmp_path / "small.png").write_bytes(reduced(folder / f"{name}.png"))
        assert np.array_equal(pixels(tmp_path / "small.png"), pixels(GALLERY / f"{name}.png")), name

"""The gallery is that of the results of the release, which are in git."""

import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.python.conftest import ROOT
from tests.workflow.conftest import plain
from workflow.lib.load import load
from workflow.pipeline.environment.variables import FIXED
from workflow.pipeline.plan import PYTHON, Plan, Run
from workflow.study.judge import judge_all
from workflow.study.report import GALLERY, numbers_file, rendered
from workflow.study.results import Results


class Released(Run):
    """A run with its result in git, also after a change of its program, which gives new results another
    identity."""

    @property
    def path(self) -> str:
        names = Path(ROOT, self.folder).glob(f"{self.name}.*.h5")
        (path,) = (
            one for one in names if one.name.removeprefix(f"{self.name}.").removesuffix(".h5").isalnum()
        )
        return str(path.relative_to(ROOT))


def pixels(picture: Path) -> np.ndarray:
    with Image.open(picture) as opened:
        return np.asarray(opened)


@pytest.mark.long
def test_gallery_is_rendered_from_the_results_of_the_release(tmp_path: Path) -> None:
    """Detected mistakes: a number, a verdict, a caption or a picture edited by hand; scripts, claims or
    configuration changed without the gallery."""
    plan = Plan("paper")
    plan.panels = {
        panel.name: replace(panel, plotted=tuple(Released(**vars(run)) for run in panel.plotted))
        for panel in plan.reported
    }
    for panel in plan.reported:
        job = panel.job(f"{tmp_path}/{panel.stem}")
        command = [PYTHON, "-m", "workflow.render"]  # as a command of make executes it
        subprocess.run(command, cwd=ROOT, input=job, text=True, check=True, env=plain() | FIXED)
    judgements = judge_all(Results(load(ROOT / path) for path in plan["verdicts"].parents))
    assert numbers_file(judgements) == (ROOT / GALLERY / "numbers.csv").read_bytes()
    page = rendered(judgements, plan, tmp_path, release=True)
    assert page == (ROOT / GALLERY / "README.md").read_bytes()
    for panel in plan.reported:
        made, kept = tmp_path / f"{panel.stem}.png", ROOT / GALLERY / f"{panel.name}.png"
        assert np.array_equal(pixels(made), pixels(kept)), panel.name

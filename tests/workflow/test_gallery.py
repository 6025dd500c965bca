"""The gallery is that of the results of the release, which are in git."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from workflow.lib.job import render_all

from tests.python.conftest import ROOT
from workflow.lib.identity import RELEASE as QUALITY
from workflow.pipeline.plan import Panel, Run, load_plan
from workflow.render.save import reduced
from workflow.study import planned, write
from workflow.study.judge import judge_all

GALLERY = ROOT / "docs/gallery"


def released(run: Run) -> str:
    """The result of a run in git, also after a change of its program, which gives new results another
    identity."""
    names = Path(ROOT, run.folder).glob(f"{run.name}.*.h5")
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
    monkeypatch.setattr(Run, "path", property(released))
    monkeypatch.setattr(Panel, "stem", property(lambda panel: str(folder / panel.name)))
    assert [reason for _, reason in render_all([panel.job for panel in plan.values()]) if reason] == []
    monkeypatch.setattr(
        Panel, "record_path", property(lambda panel: str(next(folder.glob(f"{panel.name}.*.json"))))
    )
    data = planned.Planned(QUALITY, ROOT)
    judgements = judge_all(data)
    assert write.numbers_file(judgements) == (GALLERY / "numbers.csv").read_bytes()
    assert write.rendered(judgements, data, release=True) == (GALLERY / "README.md").read_bytes()
    for name in plan:
        (tmp_path / "small.png").write_bytes(reduced(folder / f"{name}.png"))
        assert np.array_equal(pixels(tmp_path / "small.png"), pixels(GALLERY / f"{name}.png")), name

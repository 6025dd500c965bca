"""README's worked example: an observable is one source, one CMake line, one block, one script."""

import re

import pandas as pd

from tests.workflow.conftest import ROOT, Clone

BLOCK = re.compile(r"`(?P<path>[\w./]+)`:\n\n```\w+\n(?P<text>.*?)```", re.DOTALL)


def test_readme_example(kept: Clone) -> None:
    example = (ROOT / "README.md").read_text().partition("## To add an observable")[2]
    blocks = {match["path"]: match["text"] for match in BLOCK.finditer(example)}
    assert set(blocks) == {
        "cpp/observables/collision_rate.cpp",
        "cpp/CMakeLists.txt",
        "workflow/config/paper.yaml",
        "workflow/figures/rate.py",
    }
    for path, text in blocks.items():
        file = kept.folder / path
        file.write_text((file.read_text() if file.is_file() else "") + text)

    made = kept.make("describe", "panel", "PANEL=rate", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    table = pd.read_csv(kept.folder / "figures/smoke/rate.csv", comment="#")
    assert list(table.sigma) == [-0.9, -0.5, 0, 0.5, 0.9]
    assert (table.rate > 0).all()
    assert "| `collision_rate` | `rate` | 1/time |" in (kept.folder / "docs/format.md").read_text()
    # Nothing else was made again: the other programs keep their build ids.
    made = kept.make("figures", "QUALITY=smoke")
    assert "Nothing to be done" in made.stdout

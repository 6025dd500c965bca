"""The tutorial is followed to the letter, and what it says of paper.yaml is so."""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import pytest

from tests.workflow.conftest import ROOT, Clone
from workflow.lib.load import load
from workflow.lib.plan import FOLDER, load_plan

TUTORIAL, GRAMMAR = (ROOT / "docs/tutorial.md").read_text().split("## The grammar of paper.yaml")
BLOCK = re.compile(r"(?:`(?P<path>[\w./]+)`:\n\n)?```(?P<kind>\w+)\n(?P<text>.*?)```", re.DOTALL)
SIGMA = [-0.9, -0.6, -0.3, 0.3, 0.6, 0.9]


@pytest.fixture
def own(kept: Clone) -> Iterator[Clone]:
    """Without the products of the tutorial afterwards, folders included."""
    yield kept
    for folder in ("data/standard", "figures/standard", "data/smoke/kappa_sigma"):
        shutil.rmtree(kept.folder / folder, ignore_errors=True)
    for file in ("look.py", "kappa.h5", "kappa.cost.json"):
        (kept.folder / file).unlink(missing_ok=True)


def follow(clone: Clone, block: re.Match) -> str:
    """Writes a file or executes commands; returns what they say."""
    if block["path"]:
        with (clone.folder / block["path"]).open("a") as file:
            file.write(block["text"])
        return ""
    assert block["kind"] == "sh"
    return clone.run("bash", "-e", "-c", block["text"]).stdout


def test_every_step(own: Clone) -> None:
    said = "".join(follow(own, block) for block in BLOCK.finditer(TUTORIAL))
    table = pd.read_csv(own.folder / "figures/standard/kappa_sigma.csv", comment="#")
    assert list(table.sigma) == SIGMA
    assert (table.kappa > 0).all()
    row = next(line for line in said.splitlines() if re.search(r"\bkappa_sigma\b.*\b6\b.*\b6\b.* s\b", line))
    assert "to" in row  # the draft tells what the paper's quality would cost
    assert "Dimensions:" in said
    assert f"kappa at 0.6: {table.kappa[4]:.6g}"[:-1] in said
    alone = load(own.folder / "kappa.h5")
    assert alone.converged == "reached"
    assert alone.provenance["achieved_error"] <= 0.02


def test_grammar(tmp_path: Path) -> None:
    block, runs = (match["text"] for match in BLOCK.finditer(GRAMMAR))
    shutil.copytree(FOLDER, tmp_path, dirs_exist_ok=True)
    with (tmp_path / "paper.yaml").open("a") as file:
        file.write(block)
    panel = load_plan("standard", tmp_path)["example"]
    assert [run.name for run in panel.runs] == runs.split()
    options = panel.run("spaced_cells=64").options
    assert (options["relaxation-time"], options["gamma"], options["replicas"]) == ("50+0.001N^2", "N", 32)
    assert "seed" not in panel.run("mean-field_cells=16").options

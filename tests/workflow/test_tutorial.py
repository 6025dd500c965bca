"""The tutorial is executed literally, and statements on paper.yaml hold."""

import re
import shutil
from pathlib import Path

import pandas as pd
import pytest

from tests.workflow.conftest import ROOT, Project, whole_project
from workflow.lib.load import load
from workflow.pipeline.configuration import PANELS
from workflow.pipeline.plan import Plan

TEXT = (ROOT / "docs/tutorial.md").read_text()
PANEL, _, REST = TEXT.partition("## An observable of your own")
OBSERVABLE, _, REST = REST.partition("## A collision rule of your own")
_, _, GRAMMAR = REST.partition("## The grammar of paper.yaml")
BLOCK = re.compile(r"(?:`(?P<path>[\w./]+)`:\n\n)?```(?P<kind>\w+)\n(?P<text>.*?)```", re.DOTALL)
SIGMA = [-0.9, -0.6, -0.3, 0.3, 0.6, 0.9]


def follow(project: Project, block: re.Match[str]) -> str:
    """Writes a file or executes commands; returns what they print."""
    if block["path"]:
        path = project.folder / block["path"]
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a") as file:
            file.write(block["text"])
        return ""
    return project.run("bash", "-e", "-c", block["text"]).stdout


@pytest.mark.long
def test_a_panel_of_your_own(project: Project) -> None:
    shutil.copytree(ROOT / "cpp/observables", project.folder / "cpp/observables", dirs_exist_ok=True)
    shutil.copytree(ROOT / "build/bin", project.folder / "build/bin", dirs_exist_ok=True, copy_function=link)
    printed = "".join(follow(project, block) for block in BLOCK.finditer(PANEL))
    table = pd.read_csv(project.folder / "figures/standard/kappa_sigma.csv", comment="#")
    assert list(table.sigma) == SIGMA
    assert (table.kappa > 0).all()
    shown = "".join(re.findall(r"~~~text\n(.*?)~~~", PANEL, re.DOTALL)).splitlines()
    assert len(shown) == 7
    assert [line for line in shown if line not in printed] == []
    alone = load(project.folder / "kappa.h5")
    assert alone.converged == "reached"
    assert alone.provenance["achieved_error"] <= 0.02


def link(source: str, target: str) -> None:
    Path(target).unlink(missing_ok=True)
    Path(target).symlink_to(source)


@pytest.fixture
def own(tmp_path: Path) -> Project:
    return whole_project(tmp_path)


@pytest.mark.long
def test_an_observable_of_your_own(own: Project) -> None:
    for block in BLOCK.finditer(OBSERVABLE):
        follow(own, block)
    own.run("make", "panel", "PANEL=rate", "QUALITY=smoke")
    table = pd.read_csv(own.folder / "figures/smoke/rate.csv", comment="#")
    assert list(table.sigma) == [-0.9, -0.5, 0, 0.5, 0.9]
    assert (table.rate > 0).all()
    # Without relaxation every event of a run is counted.
    options = "--relaxation-time 0 --observation-time 10 --replicas 8 --seed 1 --output rate.h5"
    own.run("build/bin/collision_rate", *options.split())
    result = load(own.folder / "rate.h5")
    particles = result.parameters["cells"] * result.parameters["particles_per_cell"]
    counted = float(result["rate"].mean) * particles * 10 * 8
    assert counted == pytest.approx(result.provenance["events"], rel=1e-12)
    # The other panels stay as they are.
    assert Plan("smoke")["fig05"].record_path in own.entry("figures", "DRY=yes")


def test_configuration_of_the_tutorial_gives_its_runs(tmp_path) -> None:
    block, runs = (match["text"] for match in BLOCK.finditer(GRAMMAR))
    shutil.copytree(PANELS[0].parent, tmp_path, dirs_exist_ok=True)
    with (tmp_path / "paper.yaml").open("a") as file:
        file.write(block)
    panel = Plan("standard", [tmp_path / "paper.yaml"])["example"]
    assert [run.name for run in panel.runs] == runs.split()
    options = panel.run("spaced_cells=64").options
    assert (options["relaxation-time"], options["gamma"], options["replicas"]) == (32, "N", 32)
    assert "seed" not in panel.run("mean-field_cells=16").options

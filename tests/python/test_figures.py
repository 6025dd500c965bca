"""Loading results and saving panels: formats, provenance, reproducible bytes."""

import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import ROOT, Program
from workflow.figures.fig05 import law, tabulate
from workflow.lib.load import FormatError, load
from workflow.lib.parents import ArtefactError, Parents, file_hash


def draw(folder: Path, stem: str, data: list[Path]) -> None:
    command = [
        sys.executable,
        "-P",
        "workflow/environment/launch.py",
        "workflow.figures.fig05",
        "--configuration",
        "c0ffee",
    ]
    command += ["--sources", "workflow/figures/fig05.py", "--lock", "requirements.lock"]
    command += ["--output", str(folder / stem), "--data", *map(str, data)]
    subprocess.run(command, cwd=ROOT, check=True)


@pytest.fixture
def runs(persistence: Program, tmp_path: Path) -> list[Path]:
    paths = []
    for particles in (4, 8):
        for sigma in (-0.5, 0.5):
            paths.append(tmp_path / f"{particles}_{sigma}.h5")
            persistence(sigma=sigma, particles_per_cell=particles, output=paths[-1])
    return paths


def test_panel_is_byte_stable_and_names_its_parents(runs: list[Path], tmp_path: Path) -> None:
    draw(tmp_path, "1/smoke/panel", runs)
    time.sleep(1.1)  # longer than the resolution of a time stamp
    draw(tmp_path, "2/smoke/panel", runs)
    for kind in ("pdf", "png", "svg", "csv"):
        assert (tmp_path / f"1/smoke/panel.{kind}").read_bytes() == (
            tmp_path / f"2/smoke/panel.{kind}"
        ).read_bytes()
    named = [Parents.of(tmp_path / f"1/smoke/panel.{kind}") for kind in ("pdf", "png", "svg", "csv")]
    assert all(parents == named[0] for parents in named)
    parents = named[0]
    assert (parents.panel, parents.quality, parents.configuration) == ("panel", "smoke", "c0ffee")
    assert {path: data["sha256"] for path, data in parents.data.items()} == {
        str(path): file_hash(path) for path in runs
    }
    provenance = load(runs[0]).provenance
    assert all(data["build_id"] == provenance["build_id"] for data in parents.data.values())
    assert all(data["seed"] == provenance["seed"] for data in parents.data.values())
    assert parents.builds[provenance["build_id"]]["source_hash"] == provenance["source_hash"]
    assert parents.sources == {"workflow/figures/fig05.py": file_hash(ROOT / "workflow/figures/fig05.py")}
    assert parents.packages == file_hash(ROOT / "requirements.lock")


@pytest.mark.parametrize("kind", ["pdf", "png", "svg", "csv", "txt"])
def test_files_without_parents_are_refused(tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"x.{kind}"
    with pytest.raises(ArtefactError, match="names no parents"):
        Parents.of(path)
    path.write_text("nothing of the kind\n")
    with pytest.raises(ArtefactError, match="names no parents"):
        Parents.of(path)


def test_table_holds_what_the_files_hold(runs: list[Path], tmp_path: Path) -> None:
    draw(tmp_path, "panel", runs)
    table = pd.read_csv(tmp_path / "panel.csv", comment="#")
    assert len(table) == len(runs)
    for run in runs:
        result = load(run)
        row = table[
            (table.particles_per_cell == result.parameters["particles-per-cell"])
            & (table.sigma == result.parameters["sigma"])
        ]
        assert row.mu.item() == pytest.approx(float(result["mu"].mean), rel=1e-11)
        assert row.mu_error.item() == pytest.approx(float(result["mu"].standard_error), rel=1e-11)


def test_law_at_its_limits(runs: list[Path]) -> None:
    np.testing.assert_array_equal(law(np.array([-1.0, 0.0, 1.0])), [1.0, 0.5, 0.0])
    table = tabulate([load(run) for run in runs])
    # Equal temperatures give the law itself [eq. 10]. Particles hotter than the scatterers are reversed more
    # often if they are lighter [eq. 11].
    hotter = table.particle_energy > table.scatterer_energy
    shift = table.law_at_local_energies - table.law
    assert ((shift < 0) == (hotter == (table.sigma > 0))).all()


def test_foreign_files_are_refused(runs: list[Path], tmp_path: Path) -> None:
    (tmp_path / "text.h5").write_text("no")
    with pytest.raises(FormatError, match=r"text\.h5"):
        load(tmp_path / "text.h5")
    with h5py.File(runs[0], "r+") as file:
        file["provenance"].attrs["format_version"] = 99
    with pytest.raises(FormatError, match="99"):
        load(runs[0])

"""Loading results and saving panels: formats, parents, equal bytes."""

import re
import subprocess
import sys
import time
from pathlib import Path
from xml.etree import ElementTree

import h5py
import numpy as np
import pandas as pd
import pytest
from PIL import Image

from tests.python.conftest import ROOT, Program
from workflow.scripts.fig05 import law, tabulate
from workflow.scripts.load import FormatError, load
from workflow.scripts.save import file_hash


def draw(folder: Path, stem: str, data: list[Path]) -> None:
    command = [sys.executable, "-m", "workflow.scripts.fig05", "--configuration", "c0ffee"]
    command += ["--sources", "workflow/scripts/fig05.py", "--lock", "requirements.lock"]
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
    draw(tmp_path, "a/panel", runs)
    time.sleep(1.1)  # a time stamp would differ
    draw(tmp_path, "b/panel", runs)
    for kind in ("pdf", "png", "svg", "csv"):
        assert (tmp_path / f"a/panel.{kind}").read_bytes() == (tmp_path / f"b/panel.{kind}").read_bytes()
    wanted = [file_hash(path) for path in runs] + [file_hash(ROOT / "requirements.lock"), "c0ffee"]
    wanted.append(load(runs[0]).provenance["build_id"])
    with Image.open(tmp_path / "a/panel.png") as picture:
        png = picture.info["Description"]
    svg = " ".join(ElementTree.parse(tmp_path / "a/panel.svg").getroot().itertext())
    pdf = re.sub(rb"\\\r?\n", b"", (tmp_path / "a/panel.pdf").read_bytes()).decode("latin1")
    csv = (tmp_path / "a/panel.csv").read_text()
    for name, text in {"png": png, "svg": svg, "pdf": pdf, "csv": csv}.items():
        for parent in wanted:
            assert parent in text, name


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
    # Equal temperatures would give the law itself; hotter particles are turned back more often
    # when they are lighter than the scatterer.
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

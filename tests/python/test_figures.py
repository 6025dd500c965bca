"""Rendering a panel: files that state what they are, tables with the numbers of the results."""

import json
import resource
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import ROOT, command_line
from workflow.figures.fig05 import tabulate
from workflow.identity import drawing_sources, panel_identity, sha256, stated
from workflow.lib.closed import persistence_law
from workflow.lib.columns import as_csv
from workflow.lib.load import load
from workflow.lib.save import Parents, Text, save

KINDS = ("pdf", "png", "svg", "csv")


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("runs")
    paths = []
    for particles in (4, 8):
        for sigma in (-0.5, 0.5):
            paths.append(folder / f"{particles}_{sigma}.h5")
            options = {"sigma": sigma, "particles-per-cell": particles, "output": paths[-1]}
            subprocess.run(command_line("persistence", options), check=True)
    return paths


@pytest.fixture(scope="module")
def panel(runs: list[Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A rendered panel, without the extension of its files."""
    stem = tmp_path_factory.mktemp("figures") / "smoke/panel"
    command = [sys.executable, "-P", "-m", "workflow.figures.fig05"]
    subprocess.run([*command, "--output", stem, "--data", *runs], cwd=ROOT, check=True)
    return stem


def test_panel_states_what_it_is(panel: Path, runs: list[Path]) -> None:
    contents = {kind: panel.with_suffix(f".{kind}").read_bytes() for kind in KINDS}
    record = json.loads(panel.with_suffix(".json").read_text())
    sources = drawing_sources("fig05")
    identity = panel_identity("panel", map(str, runs), sources)
    assert {stated(content) for content in contents.values()} == {("panel", "smoke", identity)}
    assert (record["panel"], record["quality"], record["identity"]) == ("panel", "smoke", identity)
    assert record["files"] == {kind: sha256(content) for kind, content in contents.items()}
    assert record["parents"] == {str(path): sha256(path.read_bytes()) for path in runs} | sources
    assert {*sources} == {"workflow/figures/fig05.py", "workflow/lib", "uv.lock"}


def test_table_has_the_numbers_of_the_results(panel: Path, runs: list[Path]) -> None:
    table = pd.read_csv(panel.with_suffix(".csv"), comment="#")
    assert len(table) == len(runs)
    for run in runs:
        result = load(run)
        same = table.particles_per_cell == result.parameters["particles-per-cell"]
        row = table[same & (table.sigma == result.parameters["sigma"])]
        assert row.mu.item() == pytest.approx(float(result["mu"].mean), rel=1e-11)
        assert row.mu_error.item() == pytest.approx(float(result["mu"].standard_error), rel=1e-11)


def test_law_at_its_limits(runs: list[Path]) -> None:
    np.testing.assert_array_equal(persistence_law(np.array([-1.0, 0.0, 1.0])), [1.0, 0.5, 0.0])
    table = tabulate([load(run) for run in runs])
    # Equal temperatures give the law itself [eq. 10]. Particles hotter than the scatterers are reversed more
    # often if they are lighter [eq. 11].
    hotter = table.particle_energy > table.scatterer_energy
    shift = table.law_at_local_energies - table.law
    assert ((shift < 0) == (hotter == (table.sigma > 0))).all()


def test_nothing_is_left_where_the_disk_is_full(tmp_path: Path) -> None:
    figure, _ = plt.subplots()
    table = as_csv(pd.DataFrame({"a": [1.0]}), {"a": "1"})
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limit[1]))
    try:
        with pytest.raises(OSError, match="File too large"):
            save(figure, table, tmp_path / "a", Text("t", "c"), Parents("0" * 12, [], {}))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        plt.close(figure)
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize(
    "script", sorted((ROOT / "workflow/figures").glob("*.py")), ids=lambda path: path.stem
)
def test_a_script_imports_no_other_script(script: Path) -> None:
    """Its identity would lack that script (`run` in lib/figure.py refuses it)."""
    assert "workflow.figures" not in script.read_text()

"""Rendering a panel: reproducible bytes, parents that every file states, tables with the numbers of the results."""

import json
import resource
import subprocess
import sys
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from workflow.lib.closure import sources_of
from workflow.lib.figure_metadata import MetadataError, Parents, embedded, read_panel
from workflow.lib.record import is_whole, record_path, records_of, write_with_record

from tests.python.conftest import ROOT, command_line
from workflow.figures.fig05 import tabulate
from workflow.files import file_hash
from workflow.lib import closure
from workflow.lib.closed import persistence_law
from workflow.lib.columns import as_csv
from workflow.lib.load import load
from workflow.lib.save import Text, save
from workflow.plan import load_plan

KINDS = ("pdf", "png", "svg", "csv")
SCRIPT = "workflow/figures/fig05.py"


def draw(stem: Path, data: list[Path]) -> None:
    command = [sys.executable, "-P", "-m", "workflow.figures.fig05"]
    subprocess.run([*command, "--output", stem, "--data", *data], cwd=ROOT, check=True)


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
    draw(stem, runs)
    return stem


def test_panel_is_byte_stable_and_states_its_parents(panel: Path, runs: list[Path], tmp_path: Path) -> None:
    time.sleep(1.1)  # longer than the resolution of a time stamp
    draw(tmp_path / "smoke/panel", runs)
    files = [panel.with_suffix(f".{kind}") for kind in KINDS]
    assert all(path.read_bytes() == (tmp_path / "smoke" / path.name).read_bytes() for path in files)
    (path,) = records_of(panel)
    record = read_panel(path)
    assert record["files"] == {path.name: file_hash(path) for path in files}
    parents = record["parents"]
    assert [embedded(path) for path in files] == [*[parents.as_json()] * 3, parents.identity]
    assert path.name == f"panel.{parents.identity}.json"
    assert (parents.panel, parents.quality) == ("panel", "smoke")
    provenance = load(runs[0]).provenance
    stated = {"build_id": provenance["build_id"], "seed": provenance["seed"]}
    assert parents.data == {str(path): {"sha256": file_hash(path)} | stated for path in runs}
    assert parents.builds[provenance["build_id"]]["source_hash"] == provenance["source_hash"]
    assert parents.sources == {path: file_hash(ROOT / path) for path in (*sources_of(SCRIPT), "uv.lock")}


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


@pytest.mark.parametrize("kind", [*KINDS, "txt"])
def test_a_damaged_or_foreign_file_is_refused_in_a_line(panel: Path, tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"panel.{kind}"
    whole = panel.with_suffix(path.suffix).read_bytes() if kind != "txt" else b"text"
    for size in (0, 1, 9, 50):
        path.write_bytes(whole[:size])
        with pytest.raises(MetadataError, match=path.name) as raised:
            embedded(path)
        assert "\n" not in str(raised.value)


@pytest.mark.parametrize("content", ["", "{}", "[1]", '{"parents": {"panel": 5}, "files": {}}'])
def test_a_damaged_record_is_refused(tmp_path: Path, content: str) -> None:
    (tmp_path / "x.json").write_text(content)
    with pytest.raises(MetadataError, match=r"x\.json is not the record of a panel"):
        read_panel(tmp_path / "x.json")
    with pytest.raises(MetadataError, match="panel fig08 at quality paper, rendered by another version"):
        Parents.parse(json.dumps({"panel": "fig08", "quality": "paper", "more": 1}))


def test_nothing_is_left_where_the_disk_is_full(tmp_path: Path) -> None:
    figure, _ = plt.subplots()
    parents = Parents("a", "smoke", {}, {}, {}, "")
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limit[1]))
    try:
        with pytest.raises(OSError, match="File too large"):
            save(
                figure,
                as_csv(pd.DataFrame({"a": [1.0]}), {"a": "1"}),
                tmp_path / "a",
                Text("t", "c"),
                parents,
            )
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        plt.close(figure)
    assert [*tmp_path.iterdir()] == []


def test_imports_are_followed() -> None:
    sources = sources_of(SCRIPT)
    assert {SCRIPT, "workflow/lib/style.py", "workflow/lib/fit.py", "workflow/lib/save.py"} <= {*sources}
    assert "workflow/lib/growth.py" not in sources
    assert all(
        (ROOT / f"workflow/figures/{panel.script}.py").is_file() for panel in load_plan("smoke").values()
    )


def test_a_record_is_whole_if_its_files_are_as_stated(tmp_path: Path) -> None:
    stem = tmp_path / "fig05"
    write_with_record(stem, "0" * 12, {stem.with_suffix(".csv"): b"1"}, {})
    foreign = tmp_path / "fig05_inset.000000000000.json"  # record of another panel
    foreign.write_text("{}")
    write_with_record(stem, "1" * 12, {stem.with_suffix(".csv"): b"2"}, {})
    assert records_of(stem) == [record_path(stem, "1" * 12)]
    assert foreign.exists()
    assert is_whole(record_path(stem, "1" * 12))
    stem.with_suffix(".csv").write_bytes(b"3")
    assert not is_whole(record_path(stem, "1" * 12))
    stem.with_suffix(".csv").unlink()
    assert not is_whole(record_path(stem, "1" * 12))


CLOSURE = {
    "workflow/figures/mine.py": "from . import beside\nfrom .helpers import F\nimport workflow.lib.fit\nNAME = 'table.csv'\n",
    "workflow/figures/beside.py": "PAGES = Path(__file__).parent / 'pages'\n",
    "workflow/figures/helpers.py": "F = 'config/units.json'\n",
    "workflow/figures/table.csv": "1",
    "workflow/figures/pages/a.txt": "a",
    "workflow/config/units.json": "{}",
    "workflow/lib/fit.py": "from workflow.lib import growth\n",
    "workflow/lib/growth.py": "'figures'\n",  # a literal that names a folder, but not one beside the module
    "workflow/figures/unused.py": "",
}


def test_the_closure_of_a_script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The closure includes relative imports, and files and folders that a literal names; it excludes all other files."""
    for path, text in CLOSURE.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    monkeypatch.setattr(closure, "ROOT", tmp_path)
    assert sources_of("workflow/figures/mine.py") == sorted(CLOSURE.keys() - {"workflow/figures/unused.py"})


def test_a_script_that_reads_a_file_without_naming_it_is_refused(runs: list[Path], tmp_path: Path) -> None:
    script = ROOT / "workflow/figures/of_a_test.py"
    table = ROOT / "workflow/figures/of_a_test.csv"
    script.write_text(
        (ROOT / SCRIPT)
        .read_text()
        .replace("def draw(", 'open("workflow/figures/of_a" + "_test.csv")\n\n\ndef draw(')
    )
    table.write_text("1")
    try:
        command = [
            sys.executable,
            "-P",
            "-m",
            "workflow.figures.of_a_test",
            "--output",
            tmp_path / "a",
            "--data",
            *runs,
        ]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    finally:
        script.unlink()
        table.unlink()
    assert done.returncode == 1
    assert "of_a_test.py reads workflow/figures/of_a_test.csv, and no literal" in done.stderr
    assert [*tmp_path.iterdir()] == []

"""Rendering a panel: files that state what they are, and are written together or not at all; tables with the
numbers of the results."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from tests.python.conftest import ROOT, command_line
from workflow.lib.caption import WARNINGS
from workflow.lib.identity import sha256
from workflow.lib.load import NOT_TESTED, load
from workflow.render.files import format_os_error, write_atomically
from workflow.render.record import SHARED, panel_identity, read_identity_line, sources_of_panel


def render(script: str, stem: Path, paths: list[Path], status: int = 0) -> str:
    """Renders a panel; returns what is printed."""
    job = {"script": f"workflow/figures/{script}.py", "stem": str(stem), "results": [*map(str, paths)]}
    command = [sys.executable, "-m", "workflow.render"]
    done = subprocess.run(
        command, cwd=ROOT, input=json.dumps(job), stderr=subprocess.PIPE, text=True, check=False
    )
    assert done.returncode == status, done.stderr
    return done.stderr


def test_a_panel_states_what_it_is_and_has_the_numbers_of_the_results(tmp_path: Path) -> None:
    paths = [tmp_path / "4.h5", tmp_path / "8.h5"]
    for path in paths:
        options = {"particles-per-cell": path.stem, "output": path}
        subprocess.run(command_line("persistence", options), check=True)
    stem = tmp_path / "smoke/panel"
    render("fig05", stem, paths)

    contents = {kind: stem.with_suffix(f".{kind}").read_bytes() for kind in ("pdf", "png", "svg", "csv")}
    (path,) = stem.parent.glob("panel.*.json")
    record = json.loads(path.read_text())
    sources = sources_of_panel("workflow/figures/fig05.py")
    identity = panel_identity("panel", map(str, paths), sources)
    assert {read_identity_line(content) for content in contents.values()} == {("panel", "smoke", identity)}
    assert (record["panel"], record["quality"], record["identity"]) == ("panel", "smoke", identity)
    assert record["files"] == {kind: sha256(content) for kind, content in contents.items()}
    assert (record["parents"], record["sources"]) == ([*map(str, paths)], sources)
    assert {*sources} == {"workflow/figures/fig05.py", *SHARED}

    table = pd.read_csv(stem.with_suffix(".csv"), comment="#")
    assert len(table) == len(paths)
    for path in paths:
        mu, row = load(path)["mu"], table[table.particles_per_cell == int(path.stem)]
        assert row.mu.item() == pytest.approx(float(mu.mean), rel=1e-11)
        assert row.mu_error.item() == pytest.approx(float(mu.standard_error), rel=1e-11)
    # From scatterers at rest that are heavier, the conserved momentum lowers mu [eq. 10].
    assert (table.at_momentum < table.law).all()


def test_warnings_of_the_results_of_other_panels(tmp_path: Path) -> None:
    """Two replicas are too few to test whether the chain is stationary. Detected mistakes: only results of
    the panel itself are named in its caption; only those that failed the test."""
    paths = [tmp_path / "other/deterministic.h5", tmp_path / "panel/rare.h5"]
    for path in paths:
        path.parent.mkdir()
        options = {"cells": 4, "replicas": 2, "observation-time": 2, "output": path}
        subprocess.run(command_line("steady_profile", options), check=True)
    stem = tmp_path / "smoke/panel"
    render("fig02_upper", stem, paths)
    (record,) = stem.parent.glob("panel.*.json")
    assert WARNINGS[NOT_TESTED] + ": `deterministic` and `rare`." in json.loads(record.read_text())["caption"]


def test_a_panel_without_a_value_is_refused_in_one_line(tmp_path: Path) -> None:
    """Between equal baths κ is undefined. Detected mistake: a traceback, `cannot be log-scaled`."""
    path = tmp_path / "data/deterministic.h5"
    path.parent.mkdir()
    options = {"cells": 4, "replicas": 4, "observation-time": 2, "relaxation-time": 1, "output": path}
    options |= {"temperature-left": 100, "temperature-right": 100}
    subprocess.run(command_line("conductivity", options), check=False, stderr=subprocess.DEVNULL)
    printed = render("fig08", tmp_path / "fig08", [path], status=1)
    assert printed.startswith("no value to draw: ")
    assert printed.count("\n") == 1


def test_a_failure_leaves_the_previous_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = tmp_path / "one", tmp_path / "other"
    write_atomically({first: b"1", second: b"2"})
    write = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        if path.name.startswith("other"):
            raise OSError(28, "No space left on device", str(path))
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left") as error:
        write_atomically({first: b"3", second: b"4"})
    assert format_os_error(error.value) == f"{second}.{os.getpid()}.tmp: No space left on device"
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"one": b"1", "other": b"2"}

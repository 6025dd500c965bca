"""Mistakes in the configuration are reported in one line each, with file, line, keys, problem and remedy."""

import re
from pathlib import Path

import pytest

from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import Plan, runs_of
from workflow.pipeline.program import require_valid

PAPER = """# two lines
panels:
  mu:
    program: persistence
    common:
      cells: 11
      relaxation-time: 0.05N
    series:
      all: {sigma: [0, 0.5]}
      dense: {sigma: 0.5, zero-total-momentum: true}
  peak:
    program: energy_pulse
    series:
      ring: {cells: 100, times: "200,600"}
  heat:
    uses: [peak]
    script: peak
    series:
      chain: {program: conductivity, start: warm, cell-length: 1/N}
"""
SMOKE = """default: {replicas: 4}
panels:
  mu: {replicas: 8, dense: {replicas: 2}}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "quality").mkdir()
    (tmp_path / "paper.yaml").write_text(PAPER)
    (tmp_path / "quality/smoke.yaml").write_text(SMOKE)
    return tmp_path


def refusal(folder: Path) -> list[str]:
    with pytest.raises(ConfigurationError) as raised:
        Plan("smoke", [folder / "paper.yaml"])
    return str(raised.value).split("\n")


# A mistake, and what its message names: line, keys, or the value that was meant.
MISTAKES = [
    ("cells: 11", "replicas: 9", ":5: panels.mu.common: replicas: give it in quality/"),
    ("      cells: 11", "\tcells: 11", ":6:1: "),
    ("cells: 11", "cells: 11\n      cells: 11", ":7:7: duplicate key cells"),
    ("{sigma: 0.5, z", "{<<: {cells: 3}, sigma: 0.5, sigma: 0.6, z", "duplicate key sigma"),
    ("[0, 0.5]", "[0, 0.5, 0.5]", ":9: panels.mu.series.all.sigma: "),
    ("  heat:", "  report:", "report"),
    ("      all: {", "      κ_σ: {", ":8: panels.mu.series: "),
    ("    program: persistence\n", "", ":8: panels.mu.series.all: None"),
    ("persistence", "persistance", "did you mean persistence?"),
    ("[peak]", "[peek]", ":16: panels.heat.uses.0: peek is not a panel with runs; did you mean peak?"),
    ("{replicas: 4}", "{error: 2}", ":1: default.error: "),
    ("dense: {replicas: 2}", "dense: {seed: 2}", ":3: panels.mu.dense"),
    ("dense: {replicas: 2}", "densest: {replicas: 2}", "did you mean dense?"),
    ("dense: {replicas: 2}", "omit: [densest]", "did you mean dense?"),
    ("  mu: {", "  nu: {", ":3: panels.nu: nu is not a panel"),
]
# Options that a program refuses before anything is computed: series, run, option, value and what is allowed.
REFUSED = [
    (
        "cells: 11",
        "cells: 0",
        ":6: panels.mu.common.cells: all_sigma=0 and 2 more: persistence: error: --cells: '0'",
    ),
    ("[0, 0.5]", "[0, -3]", "all_sigma=-3: persistence: error: --sigma: '-3'"),
    ("0.05N", "20 + N", "--relaxation-time: '20 + N'"),
    ("0.05N", ".nan", "--relaxation-time: 'nan'"),
    ("warm", "tepid", "empty, warm, cold, hot"),
    ("dense: {replicas: 2}", "dense: {cells: -1}", ":3: panels.mu.dense.cells: dense: "),
    ("{replicas: 4}", "{replicas: 0}", ":1: default.replicas: "),
]


def change(folder: Path, old: str, new: str) -> Path:
    """The file of the folder that has the text, changed."""
    name, text = ("paper.yaml", PAPER) if old in PAPER else ("quality/smoke.yaml", SMOKE)
    (folder / name).write_text(text.replace(old, new, 1))
    return folder / name


@pytest.mark.parametrize(("old", "new", "named"), MISTAKES)
def test_a_mistake_is_reported_in_one_line(folder: Path, old: str, new: str, named: str) -> None:
    file = change(folder, old, new)
    lines = refusal(folder)
    assert all(re.match(rf"{file}:[0-9]+:([0-9]+:)? ", line) for line in lines)
    assert any(named in line for line in lines), lines


@pytest.mark.parametrize(("old", "new", "named"), REFUSED)
def test_options_are_checked_by_the_programs(folder: Path, old: str, new: str, named: str) -> None:
    file = change(folder, old, new)
    with pytest.raises(ConfigurationError) as raised:
        require_valid(runs_of(Plan("smoke", [folder / "paper.yaml"])).values())
    lines = str(raised.value).split("\n")
    assert all(re.match(rf"{file}:[0-9]+: (panels|default)", line) for line in lines)
    assert any(named in line for line in lines), lines


@pytest.mark.parametrize("content", [None, b"", b"- 1", b"a: \xff"])
def test_a_file_that_is_no_yaml_mapping_is_reported_in_one_line(folder: Path, content: bytes | None) -> None:
    (folder / "paper.yaml").unlink()
    if content is not None:
        (folder / "paper.yaml").write_bytes(content)
    (line,) = refusal(folder)
    assert "paper.yaml" in line

"""Mistakes in the configuration are reported in one line each, with file, line, column, key, problem and
remedy."""

import re
from pathlib import Path

import pytest

from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import Plan

PAPER = """panels:
  model: {}
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


# A mistake, and what its message names: position, key, or the value that was meant.
MISTAKES = [
    ("cells: 11", "cells: 0", "6:7: panels.mu.common.cells: "),
    ("cells: 11", "cels: 11", "did you mean cells?"),
    ("cells: 11", "replicas: 9", "quality/*.yaml"),
    ("      cells: 11", "\tcells: 11", ":6:1: "),
    ("cells: 11", "cells: 11\n      cells: 11", ":7:7: "),
    ("[0, 0.5]", "[0, -3]", "all.sigma.1: "),
    ("[0, 0.5]", "[0, 0.5, 0.5]", "all.sigma: 0.5 is listed"),
    ("0.05N", "20 + N", "50+0.01N^2"),
    ("  heat:", "  report:", "report"),
    ("0.05N", ".nan", ":7:7: "),
    ("      all: {", "      κ_σ: {", ":9:7: "),
    ("[0, 0.5]", "[0, 0.49999999999999994]", ":9: 0.49999999999999994 is 0.5 with"),
    ("200,600", "200,0.30000000000000004e3", ":14: 0.30000000000000004e3 is 300 with"),
    ("warm", "tepid", "empty, warm, cold, hot"),
    ("    program: persistence\n", "", "mu.series.all: "),
    ("[peak]", "[peek]", "did you mean peak?"),
    ("{replicas: 4}", "{error: 2}", "default.error: "),
    ("dense: {replicas", "dense: {sigma", "dense.sigma: "),
    ("dense: {replicas: 2}", "omit: [densest]", "remove it here; did you mean dense?"),
]


@pytest.mark.parametrize(("old", "new", "named"), MISTAKES)
def test_a_mistake_is_reported_in_one_line(folder: Path, old: str, new: str, named: str) -> None:
    name, text = ("paper.yaml", PAPER) if old in PAPER else ("quality/smoke.yaml", SMOKE)
    (folder / name).write_text(text.replace(old, new, 1))
    lines = refusal(folder)
    assert all(re.match(rf"{folder / name}:[0-9]+:([0-9]+:)? ", line) for line in lines)
    assert any(named in line for line in lines), lines


@pytest.mark.parametrize("content", [None, b"", b"- 1", b"a: \xff"])
def test_a_file_that_is_no_yaml_mapping_is_reported_in_one_line(folder: Path, content: bytes | None) -> None:
    (folder / "paper.yaml").unlink()
    if content is not None:
        (folder / "paper.yaml").write_bytes(content)
    (line,) = refusal(folder)
    assert "paper.yaml" in line

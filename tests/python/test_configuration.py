"""Mistakes in the configuration are reported in one line each, with file, line, column, key, problem and remedy."""

import re
from pathlib import Path

import pytest

from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import load_plan

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
    program: correlation
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
    load_plan.cache_clear()
    with pytest.raises(ConfigurationError) as raised:
        load_plan("smoke", folder)
    return str(raised.value).split("\n")


MISTAKES = [
    ("cells: 11", "cells: 0", "6:7: panels.mu.common.cells: 0 is invalid; allowed: a whole number from 1"),
    ("cells: 11", "cels: 11", "cels: persistence has no such option; did you mean cells?"),
    ("cells: 11", "replicas: 9", "replicas: belongs into quality/*.yaml"),
    ("cells: 11", "seed: 9", "seed: follows from the names of panel and run; `make panel SEED=7`"),
    ("      cells: 11", "\tcells: 11", ":1: found character '\\t'"),
    ("cells: 11", "cells: 11\n      cells: 11", '7:7: found duplicate key "cells"'),
    ("[0, 0.5]", "[0, -3]", "all.sigma.1: -3 is invalid; allowed: a number from -1 to 1"),
    ("1/N", "1/M", '"1/M" is invalid; allowed: a number from 1e-30 to 1e+30, or 1/N'),
    ("warm", "tepid", '"tepid" is unknown; choose one of empty, warm, cold, hot'),
    ('"200,600"', '"200;600"', "allowed: numbers from 1e-30 to 1e+30, ascending, separated by commas"),
    ("0.05N", "-0.05N", '"-0.05N" is invalid; allowed: a number from 0'),
    ("persistence", "persistance", '"persistance" is unknown; did you mean persistence?'),
    ("    program: persistence\n", "", "mu.series.all: 'program' is a required property"),
    ("script:", "skript:", "panels.heat.skript: unknown key; did you mean script?"),
    ("[peak]", "[peek]", "panels.heat.uses.0: peek has no runs; did you mean peak?"),
    ("panels:", "panel:", "1:1: panel: unknown key; did you mean panels?"),
    ("{replicas: 4}", "{error: 2}", "default.error: 2 is invalid; allowed: a number greater than 0 and less"),
    ("dense: {replicas", "dense: {sigma", "dense.sigma: belongs into paper.yaml"),
    (
        "dense: {replicas",
        "denser: {replicas",
        "mu.denser: is not in paper.yaml as a series of mu: remove it here; did you mean dense?",
    ),
    (
        "dense: {replicas: 2}",
        "omit: [densest]",
        '"densest" is not in paper.yaml as a series of mu: remove it here; did you mean dense?',
    ),
    ("  mu: {", "  moo: {", "panels.moo: is not in paper.yaml as a panel: remove it here; "),
]


@pytest.mark.parametrize(("old", "new", "words"), MISTAKES)
def test_a_mistake_is_reported_in_one_line(folder: Path, old: str, new: str, words: str) -> None:
    name, text = ("paper.yaml", PAPER) if old in PAPER else ("quality/smoke.yaml", SMOKE)
    (folder / name).write_text(text.replace(old, new, 1))
    lines = refusal(folder)
    assert all(re.match(rf"{folder / name}:[0-9]+:[0-9]+: ", line) for line in lines)
    assert any(words in line for line in lines)


@pytest.mark.parametrize("content", [None, b"", b"- 1", b"a: \xff"])
def test_a_file_that_is_no_configuration(folder: Path, content: bytes | None) -> None:
    (folder / "paper.yaml").unlink()
    if content is not None:
        (folder / "paper.yaml").write_bytes(content)
    (line,) = refusal(folder)
    assert "paper.yaml" in line

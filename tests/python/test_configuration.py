"""Mistakes in the configuration are reported in one line each, with file, line, column, key, problem and remedy."""

import re
from pathlib import Path

import pytest

from workflow.configuration import ConfigurationError, arguments, read
from workflow.plan import load_plan, panel_named

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
    ("cells: 11", "cells: true", "cells: true is invalid; allowed: a whole number"),
    ("cells: 11", "cels: 11", "cels: persistence has no such option; did you mean cells?"),
    ("cells: 11", "replicas: 9", "replicas: belongs into quality/*.yaml"),
    ("cells: 11", "seed: 9", "seed: follows from the names of panel and run; `make panel SEED=7`"),
    ("      cells: 11", "\tcells: 11", ":1: found character '\\t'"),
    ("cells: 11", "cells: 11\n      cells: 11", '7:7: found duplicate key "cells"'),
    ("cells: 11", "cells: *none", "found undefined alias 'none'"),
    ("[0, 0.5]", "[0, -3]", "all.sigma.1: -3 is invalid; allowed: a number from -1 to 1"),
    ("[0, 0.5]", "[0.5, 0.5]", "all.sigma: [0.5, 0.5] has non-unique elements"),
    ("1/N", "1/M", '"1/M" is invalid; allowed: a number from 1e-30 to 1e+30, or 1/N'),
    ("warm", "tepid", '"tepid" is unknown; choose one of empty, warm, cold, hot'),
    ('"200,600"', '"200;600"', "allowed: numbers from 1e-30 to 1e+30, ascending, separated by commas"),
    ("0.05N", "-0.05N", '"-0.05N" is invalid; allowed: a number from 0'),
    ("momentum: true", "momentum: yes", '"yes" is invalid; allowed: true or false'),
    ("persistence", "persistance", '"persistance" is unknown; did you mean persistence?'),
    ("    program: persistence\n", "", "mu.series.all: 'program' is a required property"),
    ("  mu:", "  m u:", 'panels: "m u" is invalid; allowed: letters, digits'),
    ("script:", "skript:", "panels.heat.skript: unknown key; did you mean script?"),
    ("[peak]", "[peek]", "panels.heat.uses.0: peek has no runs; did you mean peak?"),
    ("[peak]", "[model]", "panels.heat.uses.0: model has no runs"),
    ("panels:", "panel:", "1:1: panel: unknown key; did you mean panels?"),
    ("{replicas: 4}", "{replicas: -1}", "default.replicas: -1 is invalid; allowed: a whole number from 1"),
    ("{replicas: 4}", "{error: 2}", "default.error: 2 is invalid; allowed: a number greater than 0 and less"),
    ("dense: {replicas", "dense: {sigma", "dense.sigma: belongs into paper.yaml"),
    ("dense: {replicas", "denser: {replicas", "panels.mu.denser: unknown key; did you mean dense?"),
    ("dense: {replicas: 2}", "omit: [densest]", '"densest" is unknown; did you mean dense?'),
    ("  mu: {", "  moo: {", "panels.moo: unknown key; "),
]


@pytest.mark.parametrize(("old", "new", "words"), MISTAKES)
def test_a_mistake_is_reported_in_one_line(folder: Path, old: str, new: str, words: str) -> None:
    name, text = ("paper.yaml", PAPER) if old in PAPER else ("quality/smoke.yaml", SMOKE)
    (folder / name).write_text(text.replace(old, new, 1))
    lines = refusal(folder)
    assert all(re.match(rf"{folder / name}:[0-9]+:[0-9]+: ", line) for line in lines)
    assert any(words in line for line in lines)


def test_the_position_of_a_mistake_and_the_order_of_two(folder: Path) -> None:
    """A mistake in a mapping that others merge is reported once, at the position of this mapping."""
    (folder / "paper.yaml").write_text(
        "panels:\n  mu:\n    program: persistence\n    common: &shared {cells: 1,\n      sigma: 2}\n"
        "    series:\n      all: {<<: *shared}\n      dense: {gamma: 0, <<: *shared}\n"
    )
    first, second = refusal(folder)
    assert first.startswith(f"{folder}/paper.yaml:5:7: panels.mu.common.sigma: 2 is invalid")
    assert second.startswith(f"{folder}/paper.yaml:8:15: panels.mu.series.dense.gamma: 0 is invalid")


def test_yaml_of_version_1_2(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("a: 011\nb: yes\nc: 5:00\nd: 1e3\n")
    assert read(tmp_path, "a.yaml").content == {"a": 11, "b": "yes", "c": "5:00", "d": 1000.0}


@pytest.mark.parametrize("content", [None, b"", b"- 1", b"a: \xff", b"a: \x07", b"a: 1\n---\nb: 1"])
def test_a_file_that_is_no_configuration(folder: Path, content: bytes | None) -> None:
    (folder / "paper.yaml").unlink()
    if content is not None:
        (folder / "paper.yaml").write_bytes(content)
    (line,) = refusal(folder)
    assert "paper.yaml" in line


def test_an_unknown_panel_and_words_of_a_command(folder: Path) -> None:
    load_plan.cache_clear()
    with pytest.raises(ConfigurationError, match=r"^peek is not a panel; did you mean peak\?$"):
        panel_named(load_plan("smoke", folder), "peek")
    options = {"zero-total-momentum": True, "separate": False, "gamma": "N; touch x", "cells": 8.0}
    assert arguments(options) == ["--cells", "8", "--gamma", "N; touch x", "--zero-total-momentum"]

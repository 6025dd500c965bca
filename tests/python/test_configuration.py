"""Mistakes in the configuration are reported in one line each, with file, line, column, key, problem and remedy."""

import re
import shutil
from pathlib import Path

import pytest

from workflow.configuration import FOLDER, ConfigurationError, arguments, read
from workflow.plan import load_plan, panel_named


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return Path(shutil.copytree(FOLDER, tmp_path / "config"))


def refusal(folder: Path) -> list[str]:
    with pytest.raises(ConfigurationError) as raised:
        load_plan("smoke", folder)
    return str(raised.value).split("\n")


FIG05 = "panels.fig05.common"
CELLS = "      cells: 11\n"  # in fig05, the first panel with this line
PAPER = [
    (CELLS, "      cells: 0\n", f"7: {FIG05}.cells: 0 is invalid; allowed: a whole number from 1 to 1"),
    (CELLS, "      cells: true\n", f"{FIG05}.cells: true is invalid; allowed: a whole number"),
    (CELLS, "      cels: 11\n", f"7: {FIG05}.cels: persistence has no such option; did you mean cells?"),
    (CELLS, "      threads: 2\n", f"{FIG05}.threads: persistence has no such option"),
    (CELLS, "      replicas: 9\n", f"{FIG05}.replicas: belongs into quality/*.yaml"),
    (CELLS, "      seed: 9\n", f"{FIG05}.seed: follows from the names of panel and run; `make panel SEED=7`"),
    (CELLS, "\tcells: 11\n", "1: a tab; indent with spaces"),
    (CELLS, CELLS + CELLS, '7: found duplicate key "cells"'),
    (CELLS, "      cells: *none\n", "found undefined alias 'none'"),
    (
        "sigma: [-1, -0.99",
        "sigma: [-1, -3",
        "paper.sigma.1: -3 is invalid; allowed: a number from -1 to 1",
    ),
    ("sigma: [0, 0.5]", "sigma: [0.5, 0.5]", "all.sigma: [0.5, 0.5] has non-unique elements"),
    ("sigma: [0, 0.5]", "sigma: []", "all.sigma: [] should be non-empty"),
    (
        "cell-length: 1/N",
        "cell-length: 1/M",
        '"1/M" is invalid; allowed: a number from 1e-30 to 1e+30, or 1/N',
    ),
    ("start: warm", "start: tepid", '"tepid" is unknown; choose one of empty, warm, cold, hot'),
    ('"200,600,', '"200;600,', "allowed: numbers from 1e-30 to 1e+30, ascending, separated by commas"),
    (": 0.05N", ": -0.05N", '"-0.05N" is invalid; allowed: a number from 0'),
    ("momentum: true", "momentum: yes", '"yes" is invalid; allowed: true or false'),
    ("program: persistence", "program: persistance", '"persistance" is unknown; did you mean persistence?'),
    ("    program: persistence\n", "", "fig05.series.paper: 'program' is a required property"),
    ("  fig05:", "  fig 05:", 'panels: "fig 05" is invalid; allowed: letters, digits'),
    ("    script: fig04\n", "    skript: fig04\n", "panels.fig04a.skript: unknown key; did you mean script?"),
    (
        "    uses: [fig09a]",
        "    uses: [fig09]",
        "panels.fig10a.uses.0: fig09 has no runs; did you mean fig09",
    ),
    ("    uses: [fig09a]", "    uses: [fig01_inset]", "panels.fig10a.uses.0: fig01_inset has no runs"),
    ("panels:", "panel:", "1: the file: 'panels' is a required property"),
]
SMOKE = [
    ("{replicas: 4}", "{replicas: -1}", "default.replicas: -1 is invalid; allowed: a whole number from 1"),
    ("{replicas: 4}", "{replica: 4}", "default.replica: unknown key; did you mean replicas?"),
    ("{replicas: 4}", "{error: 2}", "default.error: 2 is invalid; allowed: a number greater than 0 and less"),
    ("dense: {replicas: 2", "dense: {sigma: 2", "dense.sigma: belongs into paper.yaml"),
    ("dense: {replicas", "denser: {replicas", "panels.fig05.denser: unknown key; did you mean dense?"),
    ("dense: {replicas: 2}", "omit: [densest]", '"densest" is unknown; did you mean dense?'),
    ("  fig05:", "  fig99:", "panels.fig99: unknown key; did you mean fig"),
    ("dense: {", "dense: {pairs-per-replica: 2, ", "pairs-per-replica: persistence has no such option"),
]


@pytest.mark.parametrize(
    ("file", "old", "new", "words"),
    [("paper.yaml", *each) for each in PAPER] + [("quality/smoke.yaml", *each) for each in SMOKE],
)
def test_a_mistake_is_reported_in_one_line(folder: Path, file: str, old: str, new: str, words: str) -> None:
    before, found, after = (folder / file).read_text().partition(old)
    assert found
    (folder / file).write_text(before + new + after)
    lines = refusal(folder)
    assert all(re.match(rf"{folder / file}:[0-9]+:[0-9]+: ", line) for line in lines)
    assert any(words in line for line in lines)


def test_the_position_of_a_mistake_and_the_order_of_two(folder: Path) -> None:
    """A mistake in a mapping that others merge is reported once, at the position of this mapping."""
    (folder / "paper.yaml").write_text(
        "panels:\n  a:\n    program: persistence\n    common: &shared {cells: 1,\n      sigma: 2}\n"
        "    series:\n      x: {<<: *shared}\n      y: {gamma: 0, <<: *shared}\n"
    )
    (folder / "quality/smoke.yaml").write_text("default: {replicas: 4}\n")
    first, second = refusal(folder)
    assert first.startswith(f"{folder}/paper.yaml:5:7: panels.a.common.sigma: 2 is invalid")
    assert second.startswith(f"{folder}/paper.yaml:8:11: panels.a.series.y.gamma: 0 is invalid")


def test_yaml_of_version_1_2(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(
        "a: 011\nb: yes\nc: 5:00\nd: 1e3\ne: &e {f: 1, g: 2}\nh: {<<: *e, g: 3}\n"
    )
    assert read(tmp_path, "a.yaml").content == {
        **{"a": 11, "b": "yes", "c": "5:00", "d": 1000.0},
        **{"e": {"f": 1, "g": 2}, "h": {"f": 1, "g": 3}},
    }


@pytest.mark.parametrize(
    ("content", "words"),
    [(None, "No such file"), (b"", "None is not of type 'object'"), (b"- 1", "[1] is not of type 'object'"),
     (b"a: \xff", "'utf-8' codec can't decode byte 0xff"), (b"a: \x07", "special characters are not allowed"),
     (b"a: 1\n---\nb: 1", "but found another document")],
)  # fmt: skip
def test_a_file_that_is_no_configuration(folder: Path, content: bytes | None, words: str) -> None:
    (folder / "paper.yaml").unlink()
    if content is not None:
        (folder / "paper.yaml").write_bytes(content)
    (line,) = refusal(folder)
    assert "paper.yaml" in line
    assert words in line


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("fig5", "fig5 is not a panel; did you mean fig05?"),
        ("xyz", "xyz is not a panel; choose one of model, "),
    ],
)
def test_an_unknown_panel(name: str, words: str) -> None:
    with pytest.raises(ConfigurationError) as raised:
        panel_named(load_plan("smoke"), name)
    assert str(raised.value).startswith(words)


def test_arguments() -> None:
    options = {"zero-total-momentum": True, "separate": False, "gamma": "N; touch x", "cells": 8.0}
    assert arguments(options) == ["--cells", "8", "--gamma", "N; touch x", "--zero-total-momentum"]

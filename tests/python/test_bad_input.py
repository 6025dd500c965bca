"""Bad input: exit status 2, no file, and a message with the problem, its reason and the remedy."""

import os
import resource
import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import Program, command_line

BAD_NUMBERS = [
    ("sigma", "2", "[-1, 1]"),
    ("sigma", "-1.0000001", "[-1, 1]"),
    ("sigma", "nan", "[-1, 1]"),
    ("sigma", "half", "[-1, 1]"),
    ("sigma", "", "[-1, 1]"),
    ("sigma", "0.5 ", "[-1, 1]"),
    ("sigma", "0x1p-1", "[-1, 1]"),
    ("cells", "0", "at least 1"),
    ("cells", "-3", "at least 1"),
    ("cells", "1.5", "whole number"),
    ("cells", "99999999999999999999", "whole number"),
    ("particles-per-cell", "0", "at least 1"),
    ("temperature", "-1", "greater than 0"),
    ("temperature", "0", "greater than 0"),
    ("temperature", "inf", "greater than 0"),
    ("temperature", "1e400", "greater than 0"),
    ("scatterer-temperature", "-0.1", "at least 0"),
    ("cell-length", "0", "greater than 0"),
    ("relaxation-time", "-1", "at least 0"),
    ("observation-time", "0", "greater than 0"),
    ("replicas", "0", "at least 1"),
    ("threads", "0", "at least 1"),
    ("seed", "-1", "whole number"),
    ("target-error", "-0.1", "at least 0"),
    ("progress", "loud", "auto, bar, log, none"),
]


def refused(result: subprocess.CompletedProcess, *words: str) -> None:
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith("persistence: error: ")
    assert result.stderr.count("\n") == 1
    for word in words:
        assert word in result.stderr


@pytest.mark.parametrize(("option", "value", "allowed"), BAD_NUMBERS)
def test_value_outside_its_range(
    persistence: Program, tmp_path: Path, option: str, value: str, allowed: str
) -> None:
    low, _, number = allowed.partition("at least ")
    expected = (f"[{number}, ", f"at least {number}") if number and not low else (allowed,)
    result = persistence(**{option: value})
    refused(result, f"--{option}", f"'{value}'", "--help")
    assert any(text in result.stderr for text in expected)
    assert list(tmp_path.iterdir()) == []


def test_unknown_option(persistence: Program, tmp_path: Path) -> None:
    refused(persistence(sigmma="0.5"), "--sigmma is not an option; the nearest one is --sigma.", "--help")
    assert list(tmp_path.iterdir()) == []


def test_options_that_exclude_each_other(persistence: Program, tmp_path: Path) -> None:
    refused(persistence(target_error=0.1, target_absolute=0.1), "--target-error", "--target-absolute")
    refused(persistence(cells=100_000_000, particles_per_cell=100_000_000), "--cells", "smaller chain")
    refused(
        persistence(replicas=100, max_replicas=99, target_error=0.1), "--max-replicas 99", "smaller batch"
    )
    assert list(tmp_path.iterdir()) == []


def test_output_missing(persistence: Program) -> None:
    refused(persistence(output=None), "--output", "FILE.h5")


@pytest.mark.parametrize("target", ["no/such/folder/out.h5", "/proc/out.h5", "/dev/full", "folder"])
def test_output_that_cannot_be_written(persistence: Program, tmp_path: Path, target: str) -> None:
    (tmp_path / "folder").mkdir()
    refused(persistence(output=target), target, "Name a file")
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


def test_cost_file_that_cannot_be_written(persistence: Program, tmp_path: Path) -> None:
    (tmp_path / "out.cost.json").mkdir()
    refused(persistence(), "out.cost.json", "Name a file")
    assert [path.name for path in tmp_path.iterdir()] == ["out.cost.json"]


def limit_file_size() -> None:
    """Simulates a full disk without special rights: the size of a file is limited to 1000 bytes."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))


def test_no_space_is_noticed_before_the_run(tmp_path: Path) -> None:
    # The run would take days, so the check must precede it.
    options = {"output": "out.h5", "progress": "none", "observation-time": 1e9}
    result = subprocess.run(
        command_line("persistence", options),
        cwd=tmp_path,
        env={"PATH": os.defpath},
        capture_output=True,
        text=True,
        timeout=20,
        check=False,
        preexec_fn=limit_file_size,
    )
    refused(result, "out.h5", "Free space")
    assert list(tmp_path.iterdir()) == []

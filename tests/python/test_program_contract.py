"""Common properties of all programs: provenance, determinism, interruption, targets and limits."""

import json
import signal
import socket
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import ROOT, Program, command_line
from workflow.identity import source_hash
from workflow.lib.load import load, results_digest

NOT_PARAMETERS = {"threads", "progress", "describe", "output", "resume", "checkpoint-interval", "time-limit", "part", "join",
                  "overwrite", "help", "version"}  # fmt: skip


def test_provenance_parameters_and_cost(persistence: Program, tmp_path: Path) -> None:
    """The file names neither a folder nor the machine; what differs between runs is in the file of the cost."""
    assert persistence(sigma=0.25, seed=7).returncode == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.cost.json", "out.h5"]
    result = load(tmp_path / "out.h5")
    assert result.provenance["seed"] == 7
    assert result.provenance["events"] > 0
    assert result.provenance["target_quantity"] == "mu"
    assert result.converged == "no target"
    assert result.parameters["sigma"] == 0.25
    assert result.parameters["cells"] == 5
    assert result.parameters["zero-total-momentum"] in (False, np.False_)
    cost = json.loads((tmp_path / "out.cost.json").read_text())
    assert cost["cpu_seconds"] > 0
    assert cost["peak_memory_bytes"] > 1e6
    assert cost["events"] == result.provenance["events"]
    content = (tmp_path / "out.h5").read_bytes()
    for text in (str(ROOT), str(tmp_path), "/home/", "/tmp/", socket.gethostname()):
        assert text.encode() not in content


def test_every_other_option_is_recorded(persistence: Program, tmp_path: Path) -> None:
    text = persistence(help=True).stdout
    offered = {
        word.lstrip("-") for line in text.splitlines() for word in line.split()[:1] if word.startswith("--")
    }
    persistence()
    recorded = set(load(tmp_path / "out.h5").parameters)
    assert recorded == offered - NOT_PARAMETERS


@pytest.mark.parametrize("name", ["waiting_time", "boltzmann"])
def test_results_have_a_digest(program: Program, tmp_path: Path, name: str) -> None:
    assert program(name).returncode == 0
    stored = load(tmp_path / "out.h5").provenance["results_digest"]
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        assert results_digest(file["results"]) == stored
        values = next(iter(file["results"].values()))["mean"]
        values[...] = np.nextafter(values[...], np.inf)
        assert results_digest(file["results"]) != stored


def test_bytes_do_not_depend_on_the_time(persistence: Program, tmp_path: Path) -> None:
    persistence()
    before = (tmp_path / "out.h5").read_bytes()
    time.sleep(1.1)  # longer than the resolution of time stamps in HDF5
    persistence()
    assert (tmp_path / "out.h5").read_bytes() == before


LONG = {
    "persistence": {"observation-time": 2000, "replicas": 60},
    "displacement": {"observation-time": 2000, "replicas": 60},
    "energy_pulse": {"relaxation-time": 4, "replicas": 100},
}


def started(folder: Path, name: str, *before: str) -> subprocess.Popen[str]:
    """A long run that has written a checkpoint. before: command and options that execute the program, as env."""
    command = command_line(name, {**LONG[name], "checkpoint-interval": 0.1, "threads": 2, "output": "out.h5"})
    process = subprocess.Popen([*before, *command], cwd=folder, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 30
    while not (folder / "out.h5.checkpoint").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    return process


@pytest.mark.parametrize(
    ("name", "number"),
    [("persistence", signal.SIGHUP), ("displacement", signal.SIGTERM), ("energy_pulse", signal.SIGINT)],
)
def test_interrupted_and_resumed_run_gives_the_same_bytes(
    program: Program, tmp_path: Path, name: str, number: signal.Signals
) -> None:
    keywords = {key.replace("-", "_"): value for key, value in LONG[name].items()}
    assert program(name, **keywords, output="whole.h5").returncode == 0
    process = started(tmp_path, name, "env", "--default-signal=HUP")  # needed if the tests run under nohup
    process.send_signal(number)
    _, message = process.communicate(timeout=10)
    assert process.returncode == 128 + number
    assert "--resume" in message
    assert (tmp_path / "out.h5.checkpoint").exists()
    assert not (tmp_path / "out.h5").exists()
    assert program(name, **keywords, resume=True).returncode == 0
    assert (tmp_path / "out.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()
    assert not list(tmp_path.glob("*checkpoint*"))


def test_a_closed_terminal_is_ignored_with_nohup(tmp_path: Path) -> None:
    process = started(tmp_path, "persistence", "nohup")
    assert process.poll() is None
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=60)
    assert process.returncode == 0
    assert (tmp_path / "out.h5").is_file()


@pytest.mark.parametrize(
    ("options", "known"),
    [
        ({"target_error": 1e-9, "replicas": 4, "time_limit": 1e-9}, True),
        ({"time_limit": 0.3, "replicas": 100_000, "observation_time": 200, "threads": 1}, True),
        ({"relaxation_time": 0, "observation_time": 1e-12}, False),  # no particle scatters
    ],
)
def test_a_result_short_of_its_target_is_marked(
    persistence: Program, tmp_path: Path, options: dict, known: bool
) -> None:
    result = persistence(**options, progress="log")
    assert result.returncode == 4
    assert "not reached" in result.stderr
    stored = load(tmp_path / "out.h5")
    assert stored.converged == "not reached"
    assert np.isfinite(stored["mu"].mean) == known
    if known:
        assert 2 <= stored["mu"].count < options["replicas"]


def test_progress_lines(persistence: Program) -> None:
    assert persistence(progress="none").stderr == ""
    result, warning = persistence(progress="log").stderr.splitlines()
    assert result.startswith("persistence: 4 replicas: mu = ")
    assert warning == "persistence: standard errors from 4 replicas are uncertain by about 41 %"
    bar = persistence(progress="bar", observation_time=400_000).stderr
    assert "left" in bar
    assert "\x1b[K" in bar  # erases the line to redraw it


def test_version_and_help(persistence: Program) -> None:
    assert source_hash("persistence") in persistence(version=True).stdout
    assert "--sigma" in persistence(help=True).stdout

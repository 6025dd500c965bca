"""Common properties of all programs: provenance, determinism, interruption, targets and limits."""

import json
import signal
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import ROOT, Program, command_line
from workflow.lib.load import load, results_digest

NOT_PARAMETERS = {"threads", "progress", "describe", "output", "resume", "checkpoint-interval", "time-limit", "part", "join",
                  "overwrite", "help", "version"}  # fmt: skip


def test_provenance_and_parameters(persistence: Program, tmp_path: Path) -> None:
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
    assert not NOT_PARAMETERS & set(result.parameters)


def test_every_other_option_is_recorded(persistence: Program, tmp_path: Path) -> None:
    text = persistence(help=True).stdout
    offered = {
        word.lstrip("-") for line in text.splitlines() for word in line.split()[:1] if word.startswith("--")
    }
    persistence()
    recorded = set(load(tmp_path / "out.h5").parameters)
    assert recorded == offered - NOT_PARAMETERS


def test_file_names_no_place_and_no_time(persistence: Program, tmp_path: Path) -> None:
    persistence()
    content = (tmp_path / "out.h5").read_bytes()
    for text in (
        str(ROOT),
        str(tmp_path),
        "/home/",
        "/tmp/",
        subprocess.check_output(["hostname"]).strip().decode(),
    ):
        assert text.encode() not in content


@pytest.mark.parametrize("name", ["waiting_time", "boltzmann"])
def test_results_have_a_digest(program: Program, tmp_path: Path, name: str) -> None:
    assert program(name).returncode == 0
    stored = load(tmp_path / "out.h5").provenance["results_digest"]
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        assert results_digest(file["results"]) == stored
        values = next(iter(file["results"].values()))["mean"]
        values[...] = np.nextafter(values[...], np.inf)
        assert results_digest(file["results"]) != stored


def test_cost_is_kept_beside(persistence: Program, tmp_path: Path) -> None:
    persistence()
    cost = json.loads((tmp_path / "out.cost.json").read_text())
    assert cost["cpu_seconds"] > 0
    assert cost["peak_memory_bytes"] > 1e6
    assert cost["events"] == load(tmp_path / "out.h5").provenance["events"]


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


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("persistence", signal.SIGINT),
        ("persistence", signal.SIGTERM),
        ("persistence", signal.SIGHUP),
        ("persistence", signal.SIGXCPU),
        ("persistence", signal.SIGKILL),
        ("displacement", signal.SIGTERM),
        ("energy_pulse", signal.SIGINT),
    ],
)
def test_interrupted_and_resumed_run_gives_the_same_bytes(
    program: Program, tmp_path: Path, name: str, number: signal.Signals
) -> None:
    options = {**LONG[name], "checkpoint-interval": 0.1, "threads": 2}
    keywords = {key.replace("-", "_"): value for key, value in options.items()}
    assert program(name, **{**keywords, "output": "whole.h5"}).returncode == 0
    command = command_line(name, {**options, "output": "out.h5"})
    heeding = ["env", "--default-signal=HUP", *command]  # also where nohup runs the tests
    process = subprocess.Popen(heeding, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    checkpoint = tmp_path / "out.h5.checkpoint"
    deadline = time.monotonic() + 30
    while not checkpoint.exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    process.send_signal(number)
    _, message = process.communicate(timeout=10)
    if number != signal.SIGKILL:
        assert process.returncode == 128 + number
        assert "--resume" in message
    assert checkpoint.exists()
    assert not (tmp_path / "out.h5").exists()
    with h5py.File(checkpoint) as file:
        replicas = len(file["replicas/index"])
        for tally in file["tallies"].values():
            assert tally.shape[0] == replicas
            assert tally.attrs["units"]
            assert tally.attrs["description"]

    assert program(name, **keywords, resume=True).returncode == 0
    assert (tmp_path / "out.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()
    assert not list(tmp_path.glob("*checkpoint*"))


def test_a_closed_terminal_is_ignored_with_nohup(tmp_path: Path) -> None:
    options = {**LONG["persistence"], "checkpoint-interval": 0.1, "output": "out.h5"}
    command = ["nohup", *command_line("persistence", options)]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    deadline = time.monotonic() + 30
    while not (tmp_path / "out.h5.checkpoint").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert process.poll() is None
    process.send_signal(signal.SIGHUP)
    assert process.wait(timeout=60) == 0
    assert (tmp_path / "out.h5").is_file()


def test_target_that_is_not_reached_is_reported(persistence: Program, tmp_path: Path) -> None:
    result = persistence(target_error=1e-9, replicas=4, time_limit=1e-9, progress="log")
    assert result.returncode == 4
    assert "not reached" in result.stderr
    stored = load(tmp_path / "out.h5")
    assert stored.converged == "not reached"
    assert stored["mu"].count == 2


def test_a_run_without_scatterings_is_reported(persistence: Program, tmp_path: Path) -> None:
    result = persistence(relaxation_time=0, observation_time=1e-12, progress="log")
    assert result.returncode == 4
    assert "not reached" in result.stderr
    stored = load(tmp_path / "out.h5")
    assert np.isnan(stored["mu"].mean)
    assert stored.converged == "not reached"


def test_time_limit_ends_with_a_marked_result(persistence: Program, tmp_path: Path) -> None:
    result = persistence(time_limit=0.3, replicas=100_000, observation_time=200, threads=1)
    assert result.returncode == 4
    stored = load(tmp_path / "out.h5")
    assert stored.converged == "not reached"
    assert 2 <= stored["mu"].count < 100_000


def test_progress_lines(persistence: Program) -> None:
    assert persistence(progress="none").stderr == ""
    result, warning = persistence(progress="log").stderr.splitlines()
    assert result.startswith("persistence: 4 replicas: mu = ")
    assert warning == "persistence: standard errors from 4 replicas are uncertain by about 41 %"
    bar = persistence(progress="bar", observation_time=400_000).stderr
    assert "left" in bar
    assert "\x1b[K" in bar  # erases the line to redraw it


def test_version_and_help(persistence: Program) -> None:
    identity = json.loads((ROOT / "build/id/persistence.json").read_text())
    assert identity["build_id"] in persistence(version=True).stdout
    assert "--sigma" in persistence(help=True).stdout

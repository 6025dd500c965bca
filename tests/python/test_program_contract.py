"""Common properties of all programs: provenance, cost, target errors."""

import json
import socket
from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import ROOT, Program
from tests.python.described import options_of_programs
from workflow.lib.load import ALL_AGREE, load


def test_provenance_parameters_and_cost(program: Program, tmp_path: Path) -> None:
    """The file names neither a folder nor the machine; what differs between runs is in the file of the
    cost."""
    assert program("persistence", sigma=0.25, seed=7).returncode == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.cost.json", "out.h5"]
    result = load(tmp_path / "out.h5")
    assert result.parameters["seed"] == 7
    assert result.converged == "no target"
    options = options_of_programs()["persistence"]
    assert set(result.parameters) == {
        option.replace("-", "_") for option, description in options.items() if "rule" not in description
    }
    assert (result.parameters["sigma"], result.parameters["cells"]) == (0.25, 5)
    cost = json.loads((tmp_path / "out.cost.json").read_text())
    assert cost["cpu_seconds"] > 0
    assert cost["peak_memory_bytes"] > 1e6
    assert cost["events"] == result.provenance["events"] > 0
    content = (tmp_path / "out.h5").read_bytes()
    for text in (str(ROOT), str(tmp_path), "/home/", "/tmp/", socket.gethostname()):
        assert text.encode() not in content


@pytest.mark.parametrize("targeted", [True, False])
def test_there_is_no_error_where_no_particle_turns(program: Program, tmp_path: Path, targeted: bool) -> None:
    target = {"target_error": 0.1, "replicas": None} if targeted else {}
    result = program("persistence", **target, sigma=-0.999999, observation_time=0.1)
    assert result.returncode == (4 if targeted else 0)
    stored = load(tmp_path / "out.h5")
    assert stored.converged == ("not reached" if targeted else "no target")
    assert stored.warnings == ([f"target error not reached: {ALL_AGREE}"] if targeted else [])
    assert stored["mu"].mean == 1
    assert np.isnan([stored["mu"].standard_error, stored.provenance["achieved_error"]]).all()


def test_the_error_of_an_array_is_that_of_its_least_accurate_element(
    program: Program, tmp_path: Path
) -> None:
    assert program("steady_profile").returncode == 0
    result = load(tmp_path / "out.h5")
    temperature = result["temperature_scatterer"]
    assert len(temperature.mean) > 1
    assert result.provenance["achieved_error"] == (temperature.error / temperature.mean).max()


def test_a_quantity_that_is_not_defined_misses_no_target(program: Program, tmp_path: Path) -> None:
    """No particle scatters."""
    assert program("persistence", relaxation_time=0, observation_time=1e-12).returncode == 0
    stored = load(tmp_path / "out.h5")
    assert stored.warnings == ["target quantity not defined"]
    assert np.isnan(stored["mu"].mean)


@pytest.mark.parametrize(
    "name", [name for name, options in options_of_programs().items() if "replicas" in options]
)
def test_a_single_replica_has_no_error(program: Program, tmp_path: Path, name: str) -> None:
    assert program(name, replicas=1).returncode == 0
    result = load(tmp_path / "out.h5")
    for quantity in result.quantities:
        assert np.isnan(result[quantity].standard_error).all(), quantity

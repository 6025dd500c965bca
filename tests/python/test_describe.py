"""What the programs declare about their options, and how they check a run without computing it."""

import subprocess

import pytest

from tests.python.conftest import ROOT
from tests.python.described import described, options_of_programs

# Decisions that a reader of a caption, or who chooses an effort, relies on.
ROLES = {
    "physics": "cells sigma gamma rule rotation-probability cell-length particles-per-cell temperature "
    "temperature-left nu-right scatterer-temperature zero-total-momentum energy pulse-energy "
    "pulse-cells fugacity",
    "effort": "replicas seed target-error target-scale pairs-per-replica",
    "output": "times momentum-bins momentum-max decades fit-decades tail-from positions",
    "execution": "threads progress output overwrite resume checkpoint-interval describe",
}
ROLES_IN_PROGRAMS = {
    ("relaxation-time", "persistence"): "physics",  # results depend on the age of a closed chain
    ("relaxation-time", "conductivity"): "effort",
    ("observation-time", "conductivity"): "effort",
    ("observation-time", "waiting_time"): "effort",
    ("observation-time", "displacement"): "output",  # the last of the times
    ("start", "momentum_flux"): "effort",
    ("start", "particle_count"): "physics",
}


def check(program: str, *words: str) -> subprocess.CompletedProcess:
    command = [ROOT / "build/bin" / program, *words, "--describe"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("program", described())
def test_every_option_has_types_a_role_and_a_default_unless_it_is_required(program: str) -> None:
    for name, option in described()[program]["options"].items():
        assert option["types"], name
        assert option["role"] in ROLES, name
        assert ("default" in option) == (not option["required"] and "rule" not in option), name
    required = {name for name, option in described()[program]["options"].items() if option["required"]}
    assert required == {"seed"} & options_of_programs()[program].keys()


def test_roles() -> None:
    roles = {
        (name, program): option["role"]
        for program, description in described().items()
        for name, option in description["options"].items()
    }
    for role, names in ROLES.items():
        for name in names.split():
            assert {found for key, found in roles.items() if key[0] == name} == {role}, name
    assert ROLES_IN_PROGRAMS.items() <= roles.items()


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--cells", "11", "--gamma", "12"), ("--gamma 12", "--cells 11")),
        (("--cels", "11"), ("--cels", "did you mean --cells")),
    ],
)
def test_a_run_is_checked_without_computing_it(words: tuple[str, ...], named: tuple[str, ...]) -> None:
    done = check("persistence", *words)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert all(part in done.stderr for part in named), done.stderr
    assert check("persistence", "--cells", "13", "--gamma", "12").returncode == 0

"""The roles of the options of the programs."""

from tests.python.described import described

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

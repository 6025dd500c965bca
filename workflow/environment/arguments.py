"""Checks the arguments of make, before anything else happens. Prints what is wrong with the first one that is.

Of an argument that is given more than once make keeps the last value alone, also in MAKEFLAGS and MAKEOVERRIDES (GNU make
4.3), so that it cannot be refused here.
Standard library only: this runs before anything is installed.
"""

import difflib
import re
import sys
from pathlib import Path

QUALITIES = ("smoke", "standard", "paper", "deep")
ADMITTED = {  # name: pattern of the whole value, what it may be, an example
    "QUALITY": ("|".join(QUALITIES), f"one of {', '.join(QUALITIES)}", "QUALITY=smoke"),
    "PANEL": (r"[A-Za-z0-9_-]+", "the name of a panel", "PANEL=fig05"),
    "JOBS": (r"[1-9][0-9]{0,2}", "a number of processes, from 1 to 999", "JOBS=2"),
    "FRESH": (r"yes|no|1|0|", "yes or no", "FRESH=yes"),
    "FULL": (r"yes|no|1|0|", "yes or no", "FULL=yes"),
    "SEED": (r"0|[1-9][0-9]{0,17}", "a whole number of at most 18 digits", "SEED=7"),
    "REPLICAS": (
        r"[4-9]|[1-9][0-9]{1,7}|100000000",
        "a number of replicas, from 4, as errors need some, to 100000000",
        "REPLICAS=200",
    ),
    "PROFILE": (r"[a-z][a-z0-9_-]*", "the name of a folder in profiles", "PROFILE=slurm"),
    "BATCH": (
        r"[1-9][0-9]{0,3}|0?\.[0-9]*[1-9][0-9]*",
        "the minutes that a job of a cluster is to take, up to 9999",
        "BATCH=30",
    ),
    "ACCOUNT": (r"[A-Za-z0-9._-]+", "the account that pays for a cluster's jobs", "ACCOUNT=physics"),
    "PARTITION": (r"[A-Za-z0-9._,-]+", "a partition of the cluster", "PARTITION=short"),
    "SAMPLE": (r"0?\.[0-9]*[1-9][0-9]*|1(\.0*)?", "a share, above 0 and at most 1", "SAMPLE=0.1"),
    "FILE": (r"[^\n]+", "the path of a file", "FILE=figures/standard/fig05.pdf"),
    "SECONDS": (r"[1-9][0-9]{0,4}", "the seconds that each fuzzer runs, up to 99999", "SECONDS=60"),
    "CRATE": (r"[^\n]+", "the path of a crate", "CRATE=crate.zip"),
}


EFFORT = ("QUALITY", "SEED", "REPLICAS")
RUNNING = (*EFFORT, "JOBS", "PROFILE", "BATCH", "ACCOUNT", "PARTITION")
USED = {  # by the goals that use any
    "figures": (*RUNNING, "FRESH"),
    "panel": (*RUNNING, "FRESH", "PANEL"),
    "report": RUNNING,
    "gallery": EFFORT,
    "crate": (*EFFORT, "PANEL"),
    "audit": (*EFFORT, "PANEL", "CRATE"),
    "verify": (*EFFORT, "PANEL", "SAMPLE"),
    "status": EFFORT,
    "cost": (*EFFORT, "PANEL", "PROFILE", "BATCH"),
    "provenance": ("FILE", "FULL"),
    "check": (*EFFORT, "JOBS"),
    "lint": (*EFFORT, "JOBS"),
    "tradeoff": ("QUALITY",),
    "fuzz": ("SECONDS",),
    "mutants": ("SAMPLE",),
    "help": ADMITTED,
}


def unused(goals: list[str], argument: str) -> str | None:
    """Whether all goals would ignore NAME=VALUE, in one line. Who limits `clean` does not want all of it."""
    name = argument.partition("=")[0]
    asked = ["clean"] if "clean" in goals else goals or ["help"]
    used = dict.fromkeys(one for goal in asked for one in USED.get(goal, ()))
    if name in used:
        return None
    return f"make {' '.join(asked)} does not use {name}; it uses {', '.join(used) or 'no arguments'}"


def fault(argument: str) -> str | None:
    """What is wrong with NAME=VALUE, in one line."""
    name, _, value = argument.partition("=")
    if name not in ADMITTED:
        near = difflib.get_close_matches(name.upper(), ADMITTED, 1, 0.5)
        known = f"did you mean {near[0]}" if near else f"choose from {', '.join(ADMITTED)}"
        return f"{name!r} is not an argument of this Makefile: {known}"
    pattern, admitted, example = ADMITTED[name]
    if re.fullmatch(pattern, value):
        if name == "PROFILE":
            return missing_profile(value)
        return unknown_panel(value) if name == "PANEL" else None
    near = difflib.get_close_matches(value.lower(), QUALITIES, 1) if name == "QUALITY" else []
    suggested = f"QUALITY={near[0]}" if near else example
    return f"{name}={value!r} cannot be used: it must be {admitted}; try {suggested}"


def unknown_panel(value: str) -> str | None:
    """By the names in the configuration, without a parser of YAML, which is not installed yet: what cannot be read here passes,
    and is judged by what reads it."""
    try:
        text = Path("workflow/config/paper.yaml").read_text("utf-8").partition("\npanels:")[2]
    except (OSError, UnicodeError):
        return None
    known = re.findall(r"^  ([A-Za-z0-9_-]+):", text, re.MULTILINE)
    if not known or value in known:
        return None
    near = difflib.get_close_matches(value, known, 1)
    return f"PANEL={value} is not known; " + (
        f"the nearest is {near[0]}" if near else f"there is {', '.join(known)}"
    )


def missing_profile(value: str) -> str | None:
    known = sorted(path.parent.name for path in Path("profiles").glob("*/config.yaml"))
    if value in known and value != "default":
        return None
    return f"PROFILE={value}: there is no profiles/{value}/config.yaml for a cluster; there is {', '.join(one for one in known if one != 'default')}"


def main() -> None:
    goals = [word for word in sys.argv[1:] if "=" not in word]
    for argument in (word for word in sys.argv[1:] if "=" in word):
        if found := fault(argument) or unused(goals, argument):
            print(found)
            break


if __name__ == "__main__":
    main()

"""Checks the arguments of make, before anything else happens. Prints what is wrong with the first one that is.

Of an argument that is given more than once make keeps the last value alone, also in MAKEFLAGS and MAKEOVERRIDES (GNU make
4.3), so that it cannot be refused here.
Standard library only: this runs before anything is installed.
"""

import difflib
import re
import sys

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
    "SAMPLE": (r"0?\.[0-9]*[1-9][0-9]*|1(\.0*)?", "a share, above 0 and at most 1", "SAMPLE=0.1"),
    "FILE": (r"[^\n]+", "the path of a file", "FILE=figures/standard/fig05.pdf"),
    "CRATE": (r"[^\n]+", "the path of a crate", "CRATE=crate.zip"),
}


EFFORT = ("QUALITY", "SEED", "REPLICAS")
USED = {  # by the goals that use any
    "figures": (*EFFORT, "JOBS", "FRESH"),
    "panel": (*EFFORT, "JOBS", "FRESH", "PANEL"),
    "report": (*EFFORT, "JOBS"),
    "gallery": EFFORT,
    "crate": (*EFFORT, "PANEL"),
    "audit": (*EFFORT, "PANEL", "CRATE"),
    "verify": (*EFFORT, "PANEL", "SAMPLE"),
    "status": EFFORT,
    "cost": (*EFFORT, "PANEL"),
    "provenance": ("FILE", "FULL"),
    "check": (*EFFORT, "JOBS"),
    "tradeoff": ("QUALITY",),
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
        return None
    near = difflib.get_close_matches(value.lower(), QUALITIES, 1) if name == "QUALITY" else []
    suggested = f"QUALITY={near[0]}" if near else example
    return f"{name}={value!r} cannot be used: it must be {admitted}; try {suggested}"


def main() -> None:
    goals = [word for word in sys.argv[1:] if "=" not in word]
    for argument in (word for word in sys.argv[1:] if "=" in word):
        if found := fault(argument) or unused(goals, argument):
            print(found)
            break


if __name__ == "__main__":
    main()

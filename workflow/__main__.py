"""The entry: python -m workflow TARGET NAME=value ...

Make passes its options in MAKEFLAGS. Exit status: 0, 1 if something failed or does not hold, 2 for bad input,
3 if something could not be checked.
"""

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are imported: no traceback

from workflow.lib.identity import ROOT
from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.environment import variables
from workflow.pipeline.lock import lock_products
from workflow.pipeline.make import DONE, make
from workflow.pipeline.plan import Plan
from workflow.pipeline.program import BuildError, compile_programs
from workflow.pipeline.quality import DEFAULT_QUALITY, EFFORTS, Quality
from workflow.render.files import format_os_error

QUALITY = ("QUALITY", *map(str.upper, EFFORTS))
EXECUTION = (*QUALITY, "DRY", "JOBS", "PROFILE", "ACCOUNT", "PARTITION")
TARGETS: dict[str, tuple[str, ...]] = {  # with their options
    "figures": EXECUTION,
    "panel": ("PANEL", *EXECUTION),
    "report": EXECUTION,
    "gallery": tuple(name for name in EXECUTION if name != "DRY"),
    "audit": ("PANEL", *QUALITY),
    "status": ("PANEL", *QUALITY),
    "verify": ("PANEL", "SAMPLE", *QUALITY),
    "provenance": ("FILE",),
    "build": (),
}
NEEDED = {"panel": "PANEL=fig05", "provenance": "FILE=figures/standard/fig05.pdf"}
DEFAULTS = {"QUALITY": DEFAULT_QUALITY, "SAMPLE": "0.1", "PROFILE": "default"}
OF_MAKE = "CXX="  # an option of the build, which make passes as a variable
ALLOWED = {  # pattern and description of the allowed values
    "JOBS": ("[1-9][0-9]*", "a whole number, at least 1"),
    "SAMPLE": (r"1|0?\.[0-9]+", "a fraction of the results, as 0.1"),
    "DRY": ("yes", "yes, or leave it out"),
}


class UsageError(ValueError):
    """An option or its value is unknown."""


def words_of_make(flags: str) -> list[str]:
    """Options NAME=value of the command line of make, from MAKEFLAGS, where a space in a value follows a
    backslash."""
    words = [word.replace("\\ ", " ") for word in re.findall(r"(?:\\.|[^ \\]|\\)+", flags)]
    return [word for word in words if re.match(r"[A-Za-z_]\w*=", word) and not word.startswith(OF_MAKE)]


def parse(target: str, words: list[str]) -> argparse.Namespace:
    """Options of a target by lower-case name, empty if not given. Raises UsageError."""
    if target not in TARGETS:
        raise UsageError(f"{target} is not a target; {suggestion(target, TARGETS)}")
    allowed, every = TARGETS[target], {name for names in TARGETS.values() for name in names}
    given = dict.fromkeys(every, "") | DEFAULTS
    for name in {*allowed} & os.environ.keys() - {word.partition("=")[0] for word in words}:
        text = f"{name}={os.environ[name]}"
        raise UsageError(f"{text} in the environment has no effect; give {text} to make, or unset {name}")
    for word in words:
        name, _, given[name] = word.partition("=")
        if name not in allowed:
            reason = f"has no effect on {target}" if name in every else "is not an option"
            remedy = suggestion(name.upper(), allowed) if allowed else "leave it out"
            if (target, name) == ("figures", "PANEL"):
                remedy = f"write make panel {word}"
            raise UsageError(f"{name} {reason}; {remedy}")
        pattern, description = ALLOWED.get(name, (".*", ""))
        if not re.fullmatch(pattern, given[name]):
            raise UsageError(f"{word} is invalid; give {description}")
    needed, _, _ = NEEDED.get(target, "").partition("=")
    if needed and not given[needed].strip():
        raise UsageError(f"{needed} is missing; try make {target} {NEEDED[target]}")
    return argparse.Namespace(**{name.lower(): value for name, value in given.items()})


def quality_of(options: argparse.Namespace) -> str:
    """Name of the quality. Raises ConfigurationError if its effort is invalid."""
    efforts = [f"{name}={value}" for name in EFFORTS if (value := getattr(options, name))]
    return Quality.parse("_".join([options.quality, *efforts])).name


def require_profile(profile: str) -> None:
    """Raises UsageError."""
    known = os.listdir("profiles")
    if profile not in known:
        raise UsageError(f"{profile} is not a profile; {suggestion(profile, known)}")
    if profile == "slurm" and not shutil.which("sbatch"):
        raise UsageError(
            "sbatch is not in PATH, so no job can be submitted; run make on a login node of Slurm"
        )


def run_target(target: str, options: argparse.Namespace) -> int:
    """Executes a target. Returns the exit status. Raises UsageError, ConfigurationError, BuildError,
    OSError, CalledProcessError."""
    # Modules are imported by the targets that need them: make status takes a second.
    if target == "provenance":
        from workflow.pipeline.origin import origin  # noqa: PLC0415

        return origin(options.file)
    require_profile(options.profile)
    if target == "build":
        lock_products()
        return int(bool(compile_programs()))
    names, plan = options.panel.split(), Plan(quality_of(options))
    for name in names:
        _ = plan[name]  # raises ConfigurationError
    if target in DONE:
        return make(plan, target, names, options)
    if target == "verify":
        from workflow.pipeline.verify import verify  # noqa: PLC0415

        return verify(plan, names, float(options.sample))
    from workflow.pipeline.audit import audit  # noqa: PLC0415

    return audit(plan, names, render=target == "audit")


def main() -> int:
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # as for make status | head
    target, *words = sys.argv[1:] or ["none"]
    words += words_of_make(os.environ.get("MAKEFLAGS", ""))
    try:
        options = parse(target, words)
        variables.clean()
        options.file = Path(os.path.abspath(options.file))
        os.chdir(ROOT)
        return run_target(target, options)
    except (UsageError, ConfigurationError, BuildError) as error:
        print(error, file=sys.stderr)
        return 1 if isinstance(error, BuildError) else 2
    except subprocess.CalledProcessError:  # which has printed why
        return 1
    except OSError as error:
        print(format_os_error(error), file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())

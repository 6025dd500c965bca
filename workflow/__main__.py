"""The entry: python -m workflow TARGET NAME=value ...

Make passes its options in MAKEFLAGS. Exit status: 0, 1 if something failed or does not hold, 2 for bad input, 3 if something could not be
checked.
"""

import argparse
import importlib
import os
import re
import shutil
import signal
import sys
from pathlib import Path

from workflow.environment import clean

EFFORT = ("QUALITY", "SEED", "REPLICAS", "ERROR")
EXECUTION = (*EFFORT, "FRESH", "DRY", "JOBS", "PROFILE", "ACCOUNT", "PARTITION")
TARGETS: dict[str, tuple[str, ...]] = {  # with their options
    "figures": EXECUTION,
    "panel": ("PANEL", *EXECUTION),
    "report": EXECUTION,
    "gallery": EXECUTION,
    "audit": ("PANEL", *EFFORT),
    "status": ("PANEL", *EFFORT),
    "verify": ("PANEL", "SAMPLE", *EFFORT),
    "provenance": ("FILE", "FULL"),
    "deposit": EFFORT,
    "prune": ("DRY", "QUALITY"),
}
NEEDED = {"panel": "PANEL=fig05", "provenance": "FILE=figures/standard/fig05.pdf"}
FLAGS = ("FRESH", "DRY", "FULL")
OF_MAKE = ("CXX",)  # options of make build
DEFAULTS = {"QUALITY": "standard", "SAMPLE": "0.1"}
SNAKEMAKE = ("figures", "panel", "report", "gallery")
DONE = {
    "figures": "The figures are in figures/{quality}. Next: make report {given}",
    "panel": "In figures/{quality}: {panels}.pdf and .png .svg .csv",
    "report": "The report is figures/{quality}/report.html",
    "gallery": "The gallery is docs/gallery",
}
RULES = {  # pattern and description of the allowed values
    "JOBS": ("[1-9][0-9]*", "a whole number, at least 1"),
    "SAMPLE": (r"1|0?\.[0-9]+", "a fraction of the results, as 0.1"),
    **dict.fromkeys(FLAGS, ("yes|no", "yes, or leave it out")),
}


class UsageError(ValueError):
    """An option or its value is unknown."""


def words_of_make(flags: str) -> list[str]:
    """Options NAME=value of the command line of make, from MAKEFLAGS, where a space in a value follows a backslash."""
    words = [word.replace("\\ ", " ") for word in re.findall(r"(?:\\.|[^ \\]|\\)+", flags)]
    return [word for word in words if re.match(r"[A-Za-z_]\w*=", word)]


def parse(target: str, words: list[str]) -> argparse.Namespace:
    """Options of a target by lower-case name, empty if not given. Raises UsageError."""
    from workflow.lib.nearest import nearest  # noqa: PLC0415

    if target not in TARGETS:
        raise UsageError(f"{target} is not a target; {nearest(target, TARGETS)}")
    allowed, every = TARGETS[target], {name for names in TARGETS.values() for name in names}
    given = dict.fromkeys(every, "") | DEFAULTS
    for word in words:
        name, equals, value = word.partition("=")
        if name in OF_MAKE:
            continue
        if name not in allowed or not equals:
            reason = f"has no effect on {target}" if name in every else "is not an option"
            raise UsageError(f"{name} {reason}; {nearest(name.upper(), allowed)}")
        pattern, description = RULES.get(name, (".*", ""))
        if not re.fullmatch(pattern, value):
            raise UsageError(f"{word} is invalid; give {description}")
        given[name] = "" if (name, value) in ((flag, "no") for flag in FLAGS) else value
    if target in NEEDED and not given[NEEDED[target].partition("=")[0]]:
        example = NEEDED[target]
        raise UsageError(f"{example.partition('=')[0]} is missing; try make {target} {example}")
    return argparse.Namespace(**{name.lower(): value for name, value in given.items()})


def prepare(options: argparse.Namespace) -> None:
    """Adds the effort, `quality`, the `plan`, and the requested `panels`. Raises ConfigurationError."""
    from workflow.plan import load_plan, panel_named  # noqa: PLC0415

    effort = {name: getattr(options, name) for name in ("seed", "replicas", "error")}
    options.given = " ".join(
        f"{name}={value}" for name in EFFORT if (value := getattr(options, name.lower()))
    )
    options.quality += "".join(f"_{name}={value}" for name, value in effort.items() if value)
    options.plan = load_plan(options.quality)
    options.panels = [panel_named(options.plan, name).name for name in options.panel.split()]


def snakemake(target: str, options: argparse.Namespace) -> int:
    """Makes a target of the Snakefile. Raises UsageError."""
    words = profile_words(options.profile or "default")
    from snakemake.cli import main as run  # noqa: PLC0415

    words += ["--forceall"] if options.fresh else []
    words += ["--jobs" if options.profile else "--cores", options.jobs] if options.jobs else []
    slurm = {"slurm_account": options.account, "slurm_partition": options.partition}
    if resources := [f"{name}={value}" for name, value in slurm.items() if value]:
        words += ["--default-resources", *resources]
    words += ["--config", f"quality={options.quality}"]
    words += [f"panel={' '.join(options.panels)}"] if options.panels else []
    sys.argv = ["snakemake", *words, "--", target]  # Snakemake prints its command
    try:
        run(sys.argv[1:])
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    return 0


def profile_words(name: str) -> list[str]:
    """The settings of a profile as options of Snakemake, which prints a line for each profile that it reads. Raises UsageError."""
    from workflow.configuration import read  # noqa: PLC0415
    from workflow.lib.nearest import nearest  # noqa: PLC0415

    known = [path.name for path in Path("profiles").iterdir()]
    if name not in known:
        raise UsageError(f"{name} is not a profile; {nearest(name, known)}")
    settings = read(Path("profiles") / name, "config.yaml").content
    if settings.get("executor") == "slurm" and not shutil.which("sbatch"):
        raise UsageError(
            "sbatch is not in PATH, so that no job can be submitted to Slurm; run make on a login node"
        )
    words = ["--workflow-profile", "none"]
    for key, value in settings.items():
        if value is not False:
            words += [
                f"--{key}",
                *([] if value is True else map(str, value if isinstance(value, list) else [value])),
            ]
    return words


def missing(target: str, options: argparse.Namespace) -> list[str]:
    """Products that a command would make, from their names. Raises OSError."""
    from workflow.plan import products_of, report_stem  # noqa: PLC0415

    paths = products_of(options.plan, options.panels or options.plan, options.quality)
    paths += [f"{report_stem(options.plan, options.quality)}.html"] if target == "report" else []
    return [path for path in paths if options.fresh or not os.path.exists(path)]


def run(target: str, options: argparse.Namespace) -> int:
    """Raises UsageError, ConfigurationError, OSError."""
    if target not in SNAKEMAKE:
        options.render = target == "audit"
        module = "audit" if target == "status" else target
        return int(importlib.import_module(f"workflow.provenance.{module}").main(options) or 0)
    compared = target in ("figures", "panel") and (options.seed or options.replicas or options.fresh)
    if options.dry:
        print("\n".join(missing(target, options)) or "Nothing to be made")
        return 0
    for panel in (options.plan[name] for name in options.panels if options.plan[name].replaced):
        print(
            f"{panel.name}: at this quality other {', '.join(panel.replaced)} than in paper.yaml", flush=True
        )
    if compared:
        verify = importlib.import_module("workflow.provenance.verify")
        if options.fresh:
            verify.keep(options)
    if status := snakemake(target, options):
        return status
    print(DONE[target].format(quality=options.quality, given=options.given, panels=" ".join(options.panels)))
    return int(verify.compare(options)) if compared else 0


def main() -> int:
    from workflow.configuration import ConfigurationError  # noqa: PLC0415
    from workflow.files import in_one_line  # noqa: PLC0415
    from workflow.identity import ROOT  # noqa: PLC0415

    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # as for make status | head
    target, *words = sys.argv[1:] or ["none"]
    words += words_of_make(os.environ.get("MAKEFLAGS", ""))
    clean()
    try:
        options = parse(target, words)
        options.file = os.path.abspath(options.file)
        os.chdir(ROOT)
        prepare(options)
        return run(target, options)
    except (UsageError, ConfigurationError) as error:
        print(error, file=sys.stderr)
        return 2
    except OSError as error:
        print(in_one_line(error), file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())

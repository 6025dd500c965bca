"""The entry: python -m workflow TARGET NAME=value ...

Make passes its options in MAKEFLAGS. Exit status: 0, 1 if something failed or does not hold, 2 for bad input,
3 if something could not be checked.
"""

import argparse
import importlib
import os
import re
import shutil
import signal
import subprocess
import sys
from contextlib import suppress

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are imported: no traceback

from workflow.lib.files import format_os_error, missing
from workflow.lib.identity import ROOT, panel_of
from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import ConfigurationError, panel_names
from workflow.pipeline.described import BuildError, described, options_of_programs
from workflow.pipeline.environment.variables import clean
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import (
    DEFAULT_QUALITY,
    OVERRIDES,
    REPORT,
    Selection,
    default_panels,
    files_of,
    load_plan,
    rendering_of,
    require_panel,
    runs_of,
)
from workflow.pipeline.program import build
from workflow.pipeline.records import SHORT, doubtful

SELECTION = ("QUALITY", *map(str.upper, OVERRIDES))
EXECUTION = (*SELECTION, "DRY", "JOBS", "PROFILE", "ACCOUNT", "PARTITION")
TARGETS: dict[str, tuple[str, ...]] = {  # with their options
    "figures": EXECUTION,
    "panel": ("PANEL", *EXECUTION),
    "report": EXECUTION,
    "gallery": tuple(name for name in EXECUTION if name != "DRY"),
    "audit": ("PANEL", *SELECTION),
    "status": ("PANEL", *SELECTION),
    "verify": ("PANEL", "SAMPLE", *SELECTION),
    "provenance": ("FILE",),
    "prune": ("DRY", "FORCE", *SELECTION),
    "build": (),
}
NEEDED = {"panel": "PANEL=fig05", "provenance": "FILE=figures/standard/fig05.pdf"}
DEFAULTS = {"QUALITY": DEFAULT_QUALITY, "SAMPLE": "0.1", "PROFILE": "default"}
OF_MAKE = "CXX="  # an option of the build, which make passes as a variable
DONE = {  # of the targets of Snakemake
    "figures": "The figures are in figures/{quality}. Next: make report {effort}",
    "panel": "In figures/{quality}: {panel}.pdf and .png .svg .csv",
    "report": "The report is figures/{quality}/report.html",
    "gallery": "The gallery is docs/gallery",
}
COMPILED = (*DONE, "build")  # targets that need the programs
ALLOWED = {  # pattern and description of the allowed values
    "JOBS": ("[1-9][0-9]*", "a whole number, at least 1"),
    "SAMPLE": (r"1|0?\.[0-9]+", "a fraction of the results, as 0.1"),
    "DRY": ("yes", "yes, or leave it out"),
    "FORCE": ("yes", "yes, or leave it out"),
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
    for word in words:
        name, _, given[name] = word.partition("=")
        if name not in allowed:
            reason = f"has no effect on {target}" if name in every else "is not an option"
            remedy = suggestion(name.upper(), allowed) if allowed else "leave it out"
            raise UsageError(f"{name} {reason}; {remedy}")
        pattern, description = ALLOWED.get(name, (".*", ""))
        if not re.fullmatch(pattern, given[name]):
            raise UsageError(f"{word} is invalid; give {description}")
    needed, _, _ = NEEDED.get(target, "").partition("=")
    if needed and not given[needed]:
        raise UsageError(f"{needed} is missing; try make {target} {NEEDED[target]}")
    return argparse.Namespace(**{name.lower(): value for name, value in given.items()})


def prepare(target: str, options: argparse.Namespace) -> None:
    """Adds the effort to `quality`, `effort` as arguments of make, the `plan`, and the requested `panels`;
    compiles the programs if the target needs them. Raises UsageError, ConfigurationError, BuildError,
    OSError."""
    efforts = [f"{name}={value}" for name in OVERRIDES if (value := getattr(options, name))]
    options.quality = "_".join([options.quality, *efforts])
    options.effort = Selection.parse(options.quality).arguments
    require_profile(options.profile)
    options.panels = options.panel.split()
    known = panel_names() if options.panels else []
    for name in options.panels:
        require_panel(name, known)
    options.failed = False
    if target in COMPILED and not options.dry:
        lock_products()
        if target == "build" or not has_results(target, options):
            compile_programs(target, options)
    options.plan = load_plan(options.quality)
    options.panels = requested_panels(target, options)


def requested_panels(target: str, options: argparse.Namespace) -> list[str]:
    """The requested panels; for the target figures those of the paper."""
    return default_panels(load_plan(options.quality)) if target == "figures" else options.panels


def has_results(target: str, options: argparse.Namespace) -> bool:
    """Whether all results exist, so that rendering needs no compiler."""
    with suppress(ConfigurationError):  # perhaps by former programs
        plan = load_plan(options.quality)
        return not missing(runs_of(plan, requested_panels(target, options) or plan, options.quality))
    return False


def compile_programs(target: str, options: argparse.Namespace) -> None:
    """Raises CalledProcessError."""
    failed = build()
    for former in (load_plan, described, options_of_programs):
        former.cache_clear()
    if failed:
        print(f"{', '.join(failed)}: not compiled, for the reason above", file=sys.stderr)
        options.failed = target == "build"


def require_profile(profile: str) -> None:
    """Raises UsageError."""
    known = os.listdir("profiles")
    if profile not in known:
        raise UsageError(f"{profile} is not a profile; {suggestion(profile, known)}")
    if profile == "slurm" and not shutil.which("sbatch"):
        raise UsageError(
            "sbatch is not in PATH, so no job can be submitted; run make on a login node of Slurm"
        )


def simulate(panels: list[str], options: argparse.Namespace) -> int:
    """Makes the missing results of panels by Snakemake. Returns the exit status."""
    on_cluster = options.profile != "default"
    words = [f"--workflow-profile=profiles/{options.profile}"]
    words += [f"--{'jobs' if on_cluster else 'cores'}={options.jobs}"] if options.jobs else []
    slurm = {"slurm_account": options.account, "slurm_partition": options.partition}
    resources = [f"{name}={value}" for name, value in slurm.items() if value]
    words += ["--default-resources", *resources] if resources else []
    words += ["--config", f"quality={options.quality}", f"panel={' '.join(panels)}"]
    words += ["--", "results"]
    from snakemake.cli import main as run  # noqa: PLC0415  0.5 s

    sys.argv = ["snakemake", *words]  # Snakemake prints its command
    try:
        run(words)
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    return 0


def make(target: str, options: argparse.Namespace) -> int:
    """Makes what is missing: results, panels, report; with DRY=yes, lists it. After SEED and REPLICAS
    compares with the results of the quality. Raises ConfigurationError, OSError."""
    plan, quality, names = options.plan, options.quality, options.panels or [*options.plan]
    files = {name: missing(files_of(plan, name, quality)) for name in names}
    results = missing(runs_of(plan, names, quality))
    pages = missing(files_of(plan, REPORT, quality)) if target == "report" else []
    if options.dry:
        print(
            "\n".join([*results, *(path for each in files.values() for path in each), *pages])
            or "Nothing to be made"
        )
        return 0
    for panel in (plan[name] for name in options.panel.split() if plan[name].replaced):
        print(
            f"{panel.name}: other {', '.join(panel.replaced)} in quality/{quality.partition('_')[0]}.yaml than in paper.yaml",
            flush=True,
        )
    status = simulate(names, options) if results else 0
    jobs = [rendering_of(plan, name, quality) for name in names if files[name]]
    if ready := [job.json for job in jobs if not missing(job.data)]:
        command = [".venv/bin/python", "-m", "workflow.lib.render", *ready]
        status = subprocess.run(command, check=False).returncode or status
    if status == 0 and (pages or target == "gallery"):
        command = [".venv/bin/python", "-m", "workflow.report.write", "--quality", quality]
        command += ["--gallery"] if target == "gallery" else []
        status = subprocess.run(command, check=False).returncode
    if status == 0:
        print(DONE[target].format_map(vars(options)))
        found = [path for path in doubtful(plan, names, quality) if panel_of(path) not in SHORT]
        if found:
            print(f"{len(found)} run{'s have' if found[1:] else ' has'} doubts: make status {options.effort}")
        if target in ("figures", "panel") and (options.seed or options.replicas):
            from workflow.pipeline.provenance import compare  # noqa: PLC0415  0.5 s

            status = compare.main(options)
    return status


def main() -> int:
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # as for make status | head
    target, *words = sys.argv[1:] or ["none"]
    words += words_of_make(os.environ.get("MAKEFLAGS", ""))
    clean()
    try:
        options = parse(target, words)
        options.file = os.path.abspath(options.file)
        os.chdir(ROOT)
        prepare(target, options)
        if target in COMPILED:
            return make(target, options) if target in DONE else int(options.failed)
        options.render = target == "audit"
        name = "audit" if target == "status" else target
        module = importlib.import_module(f"workflow.pipeline.provenance.{name}")
        return int(module.main(options) or 0)
    except (UsageError, ConfigurationError, BuildError) as error:
        print(error, file=sys.stderr)
        return 1 if isinstance(error, BuildError) else 2
    except subprocess.CalledProcessError:  # which has printed why
        return 1
    except OSError as error:
        print(format_os_error(error), file=sys.stderr)
        return 1
    except KeyboardInterrupt:  # of a target that stops a program first
        return 128 + signal.SIGINT


if __name__ == "__main__":
    sys.exit(main())

"""Prints for every panel whether it is fresh and if not why, its errors, what it cost and what it would cost; and the jobs of
this folder in the queue of a cluster, if there is one."""

import argparse
import math
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from contextlib import suppress

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.lib.costs import cheapest, cost_file, expected_cost
from workflow.lib.load import FormatError, load_provenance
from workflow.lib.parents import ArtefactError, Parents
from workflow.lib.plan import Panel, Quality, data_path, load_plan
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance.chain import Chain
from workflow.provenance.printable import printable
from workflow.provenance.repository import ROOT, FileHashes, untracked

GALLERY = "docs/gallery"  # small pictures of the panels
WIDE = 150  # columns, where nobody reads them on a screen


def worst_error(quality: str, panel: Panel) -> str:
    """The largest error of the panel's runs; those that had a target apart, as error and target."""
    errors, aimed = [], []
    for run in panel.runs:
        try:
            provenance = load_provenance(ROOT / data_path(quality, panel.name, run.name))
            achieved, target = (float(provenance[name]) for name in ("achieved_error", "target_error"))
        except (FormatError, KeyError, TypeError, ValueError):
            continue
        if target > 0:
            aimed.append((achieved / target, f"{achieved:.1e} of {target:.0e}"))
        elif not math.isnan(achieved):
            errors.append((achieved, f"{achieved:.1e}"))
    return "; ".join(max(found)[1] for found in (errors, aimed) if found)


def seconds(values: Iterable[float]) -> str:
    total = math.fsum(values)
    return "not known yet" if math.isnan(total) else f"{total:.1f}"


def seconds_between(ranges: Sequence[tuple[float, float]]) -> str:
    least, most = (seconds(one[end] for one in ranges) for end in (0, 1))
    return least if least == most else f"{least} to {most}"


def table(quality: str) -> Table | None:
    """None where nothing is made yet. Raises ConfigurationError."""
    plan = load_plan(quality)
    chain = Chain(quality, plan)
    stale = chain.stale(plan)
    if all(chain.unmade(panel) for panel in plan):
        return None
    start = cheapest()
    result = Table(
        "panel", "state", "largest error", "CPU s, last", "CPU s, next", title=f"Quality {quality}"
    )
    for name, panel in plan.items():
        jobs = [job for job in stale if job.split("/")[0] == name]
        reason = "not made yet" if chain.unmade(name) else stale[jobs[0]] if jobs else "fresh"
        past = [cost for run in panel.runs if (cost := cost_file(quality, name, run.name))]
        waiting = [run for run in panel.runs if f"{name}/{run.name}" in stale]
        result.add_row(
            name,
            escape(reason),
            worst_error(quality, panel),
            seconds(cost["cpu_seconds"] for cost in past) if past else "",
            seconds_between([expected_cost(name, run, start) for run in waiting]),
        )
    return result


def outdated() -> list[str]:
    """Panels of which the gallery has a picture that was drawn by code that has changed since."""
    names, hashes = [], FileHashes()
    for picture in sorted((ROOT / GALLERY).glob("*.png")):
        with suppress(ArtefactError):
            sources = Parents.of(picture).sources
            if any(hashes[path] != digest for path, digest in sources.items()):
                names.append(picture.stem)
    return names


def queue() -> str:
    """By state, the jobs of Slurm that were started here: 12 pending, 3 running. Empty without any, and without Slurm."""
    command = ["squeue", "--me", "--noheader", "--format=%T %Z"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=20, check=False)
    except (FileNotFoundError, subprocess.TimeoutExpired):
        return ""
    jobs = (line.partition(" ") for line in done.stdout.splitlines())
    states = Counter(state.lower() for state, _, folder in jobs if folder == str(ROOT))
    return ", ".join(f"{number} {state}" for state, number in sorted(states.items()))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    quality = parser.parse_args().quality
    try:
        if panels := table(quality):
            Console(width=None if sys.stdout.isatty() else WIDE).print(panels)
        else:
            given = Quality.of(quality).arguments
            print(
                f"Nothing is made: `make figures {given}` makes it, `make cost {given}` foretells what that takes"
            )
        if jobs := queue():
            print(f"Jobs in the queue: {jobs}")
        for path in untracked():
            print(
                f"{printable(path)}: untracked: no commit has it, and jobs that run now are entered as such of no commit"
            )
        if names := outdated():
            print(f"{GALLERY}: drawn by former code: {', '.join(names)}; make gallery draws them again")
    except ConfigurationError as error:
        print(f"make status: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()

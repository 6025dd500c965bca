"""Checks every link from the sources to the figures: bytes, records, builds, configuration, tables.

One line per broken link, from the sources down; status 1 if there is any.
"""

import argparse
import concurrent.futures
import sys
import tempfile
from pathlib import Path

from workflow.config.plan import ConfigurationError, data_of, load_plan
from workflow.provenance.links import Chain, Link
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.redo import RedoError, redrawn
from workflow.provenance.repository import FileHashes


def audit(quality: str, only: str | None = None) -> tuple[list[Link], str]:
    """Broken links, each as path and message, and a summary of what was looked at. If a panel is given, only
    that one is drawn again."""
    try:
        lock = Lock.read(quality)
    except LockError as error:
        return [Link(f"data/{quality}/lock.json", str(error))], ""
    try:
        plan = load_plan(quality)
    except ConfigurationError as error:
        return [Link(path, str(error)) for path in changed_configuration(lock)], ""
    chain = Chain(quality, plan, lock)
    broken = chain.broken()
    suspect = {link.job for link in broken}
    if not any(link.job is None for link in broken):
        names = [name for name in lock.drawings() if name == only or not only]
        broken += not_following(chain, names, suspect)
    missing = [name for name in plan if name not in lock.jobs]
    summary = f"{len(lock.runs())} runs, {len(lock.drawings())} panels, {len(lock.outputs())} files"
    if missing:
        summary += f"; not made yet: {', '.join(missing)}"
    if any(job.dirty for job in lock.jobs.values()):
        summary += "; some were made from sources that were not committed"
    return broken, summary


def changed_configuration(lock: Lock) -> list[str]:
    """Files that are not what they were when a product was made."""
    asked = dict(pair for job in lock.jobs.values() for pair in job.configuration.items())
    present = FileHashes()
    return [path for path, digest in asked.items() if present[path] != digest] or ["workflow/config"]


def not_following(chain: Chain, names: list[str], suspect: set[str | None]) -> list[Link]:
    """Drawings that do not follow from their data, of those with no broken link above them."""
    names = [name for name in names if not suspect & {name, *chain.shown_jobs(chain.lock.jobs[name])}]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as threads:
        found = threads.map(lambda name: contradictions(chain, name, Path(folder) / name), names)
        return [link for links in found for link in links]


def contradictions(chain: Chain, name: str, folder: Path) -> list[Link]:
    data = data_of(chain.plan, name, chain.quality)
    try:
        differing = redrawn(chain.lock.jobs[name], chain.plan[name].script, data, folder)
    except RedoError as error:
        return [Link(f"figures/{chain.quality}/{name}.csv", f"cannot be drawn again: {error}", name)]
    wrong = [path for path, rounded in differing.items() if not rounded]
    return [Link(path, "does not follow from the data that it names", name) for path in wrong]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="draw only this one again")
    options = parser.parse_args()
    broken, summary = audit(options.quality, options.panel)
    for link in broken:
        print(f"{link.path}: {link.message}")
    if broken:
        sys.exit(f"make audit: {len(broken)} broken; the first is {broken[0].path}")
    print(f"Every link holds: {summary}")


if __name__ == "__main__":
    main()

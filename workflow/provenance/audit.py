"""Checks every link from the sources to the figures: bytes, records, builds, configuration, commits, tables.

One line per link that is broken or cannot be checked, from the sources down. Status 0 if all hold, 1 if one is broken,
3 if none is but some cannot be checked, 2 for bad input.
"""

import argparse
import concurrent.futures
import sys
from dataclasses import dataclass, field
from pathlib import Path

from workflow.lib.places import is_limit
from workflow.lib.plan import Quality, load_plan, panel_named, with_used
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance import links, product_links, report_links
from workflow.provenance.chain import Chain
from workflow.provenance.crate_check import CrateError, Deposit
from workflow.provenance.links import Link
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.printable import printable
from workflow.provenance.redo import RedoError, redrawn, workplace
from workflow.provenance.repository import FileHashes, machine, no_history, signature

CHECKS = (
    links.records,
    links.packages,
    links.requests,
    links.sources,
    links.builds,
    links.executables,
    product_links.products,
    product_links.strangers,
    product_links.of_no_quality,
    links.commits,
    links.pipeline,
    links.uncommitted,
)
BROKEN, BAD_INPUT, NOT_CHECKED = 1, 2, 3  # exit statuses


@dataclass
class Findings:
    """What was found, each path once with the first thing that is wrong with it, and what was looked at."""

    found: dict[str, Link] = field(default_factory=dict)
    looked_at: str = ""

    def add(self, links: list[Link]) -> None:
        for link in links:
            known = self.found.setdefault(link.path, link)
            if link.broken and not known.broken:
                self.found[link.path] = link

    @property
    def broken(self) -> list[Link]:
        return [link for link in self.found.values() if link.broken]

    @property
    def unchecked(self) -> list[Link]:
        return [link for link in self.found.values() if not link.broken]


def audit(quality: str, only: str | None = None, deposit: Deposit | None = None) -> Findings:
    """If a panel is given, only its files are read and only it is drawn again; all are hashed. Raises ConfigurationError for an unknown quality or panel."""
    Quality.of(quality)
    findings = Findings()
    try:
        lock = Lock.read(quality)
    except LockError as error:
        findings.add([Link(f"data/{quality}/lock.json", str(error))])
        return findings
    try:
        plan = load_plan(quality)
    except ConfigurationError as error:
        findings.add([Link(path, str(error)) for path in changed_configuration(lock)])
        return findings
    if only:
        panel_named(plan, only)
    chain = Chain(quality, plan, lock)
    names = jobs_of(chain, only)
    try:
        for check in CHECKS:
            findings.add([*check(chain)])
        findings.add([*product_links.runs(chain, names), *product_links.drawings(chain, names)])
    except (AttributeError, KeyError, TypeError, ValueError) as error:  # a forged lock may hold anything
        findings.add(
            [Link(f"data/{quality}/lock.json", f"does not have the documented structure: {error!r}")]
        )
    if deposit:
        findings.add([*deposit.differences(chain, names)])
    drawn = names_to_draw(chain, [name for name in lock.drawings() if name in names], findings.broken)
    findings.add(not_following(chain, drawn))
    findings.add([*report_links.report(chain)])
    findings.looked_at = summary(chain, names, len(drawn))
    findings.looked_at += f"; compared with {deposit.extent}" if deposit else ""
    return findings


def jobs_of(chain: Chain, only: str | None) -> set[str]:
    """Those whose files are read: all, or a panel and the runs that it shows."""
    if only is None:
        return {*chain.lock.jobs}
    return {
        only,
        *(f"{panel.name}/{run.name}" for panel in with_used(chain.plan, only) for run in panel.runs),
    }


def summary(chain: Chain, names: set[str], drawn: int) -> str:
    lock = chain.lock
    runs, panels = lock.runs(), len(lock.drawings())
    text = f"{len(runs)} runs, {panels} panels, {len(lock.outputs())} files"
    text += f"; read {len(runs.keys() & names)} of {len(runs)} runs, drew {drawn} of {panels} panels again"
    named = [] if no_history() else sorted({job.commit for job in lock.jobs.values() if job.commit})
    compared = [f"{commit[:12]} ({signature(commit)})" for commit in named]
    text += f"; compared with commit {', '.join(compared)}" if compared else "; compared with no commit"
    if elsewhere := [job.machine for job in lock.jobs.values() if job.machine != machine()]:
        text += f"; {len(elsewhere)} jobs were done on another kind of machine ({elsewhere[0]})"
    if missing := [name for name in chain.plan if name not in lock.jobs]:
        text += f"; not made yet: {', '.join(missing)}"
    return text


def changed_configuration(lock: Lock) -> list[str]:
    """Files that are not what they were when a product was made."""
    asked = dict(pair for job in lock.jobs.values() for pair in job.configuration.items())
    present = FileHashes()
    return [path for path, digest in asked.items() if present[path] != digest] or ["workflow/config"]


def names_to_draw(chain: Chain, names: list[str], broken: list[Link]) -> list[str]:
    """Panels with no broken link above them."""
    if any(link.job is None for link in broken):
        return []
    suspect = {link.job for link in broken}
    makers = {path: run for run, job in chain.lock.runs().items() for path in job.outputs}
    return [
        name
        for name in names
        if not suspect & {name, *(makers.get(path) for path in chain.lock.jobs[name].data)}
    ]


def not_following(chain: Chain, names: list[str]) -> list[Link]:
    """Drawings that do not follow from their data."""
    with workplace() as place, concurrent.futures.ThreadPoolExecutor(2) as threads:
        found = threads.map(lambda name: contradictions(chain, name, place / name), names)
        return [link for links in found for link in links]


def contradictions(chain: Chain, name: str, folder: Path) -> list[Link]:
    folder.mkdir()
    try:
        differing = redrawn(chain.lock.jobs[name], folder)
    except (RedoError, OSError) as error:
        if is_limit(error):
            raise
        return [Link(f"figures/{chain.quality}/{name}.csv", f"cannot be drawn again: {error}", name)]
    return [
        links.unchecked(path, "was drawn on another kind of machine: equal but for rounding")
        if rounded
        else Link(path, "does not follow from the data that it names", name)
        for path, rounded in differing.items()
    ]


def verdict(findings: Findings) -> int:
    """Prints what was found; returns the exit status."""
    for link in findings.broken:
        print(printable(f"{link.path}: {link.message}"))
    for link in findings.unchecked:
        print(printable(f"not checked: {link.path} ({link.message})"))
    if findings.broken:
        first = findings.broken[0].path
        print(f"make audit: {len(findings.broken)} broken; the first is {printable(first)}", file=sys.stderr)
        return BROKEN
    if findings.unchecked:
        print(printable(f"Looked at {findings.looked_at}"))
        print("Nothing is broken, but not every link could be checked")
        return NOT_CHECKED
    print(printable(f"Every link holds: {findings.looked_at}"))
    return 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="draw only this one again")
    parser.add_argument("--crate", type=Path, help="compare with a deposited crate, a folder or a zip")
    options = parser.parse_args()
    try:
        deposit = Deposit.read(options.crate) if options.crate else None
        status = verdict(audit(options.quality, options.panel, deposit))
    except (ConfigurationError, CrateError) as error:
        print(printable(f"make audit: {error}"), file=sys.stderr)
        status = BAD_INPUT
    except OSError as error:
        if error.filename is None:  # of the output, not of a file that is checked
            raise
        print(printable(f"make audit: {error.filename} cannot be read: {error.strerror}"), file=sys.stderr)
        status = BAD_INPUT
    sys.exit(status)


if __name__ == "__main__":
    main()

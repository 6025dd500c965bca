"""Checks results and figures against the present options, sources and packages: `make audit`, and without
rendering `make status`.

Results and figures must be unmodified and current, and a figure that is rendered again must have equal bytes.
A panel without figure files is not made: some of its results may exist, as other panels plot them.

Exit status: 0, 1 if something is stale, edited or missing, 3 if something could not be checked or nothing is
made.
"""

import argparse
import os
import subprocess
import tempfile
from collections import Counter, defaultdict
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

from workflow.lib.files import format_os_error
from workflow.lib.identity import ROOT, panel_of, run_of, sha256, siblings, sources_of_panel
from workflow.lib.load import FormatError, load_provenance
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import (
    REPORT,
    Panel,
    Run,
    data_of,
    files_of,
    record_of,
    rendering_of,
    runs_of,
    stem_of,
)
from workflow.pipeline.records import SHORT, doubtful, read_record
from workflow.pipeline.sources import sources_changed

WRITABLE = os.access(ROOT, os.W_OK)


class Fault(NamedTuple):
    state: str  # stale, edited, missing or not checked
    path: str
    reason: str


def options_of(words: str) -> list[str]:
    """Options, each with its value, from the words of a command line."""
    return [f"--{option.strip()}" for option in words.split("--")[1:]]


def hash_if_readable(path: str) -> str:
    """sha256 of a file; empty if it cannot be read."""
    try:
        return sha256(Path(path).read_bytes())
    except OSError:
        return ""


@cache
def tracked() -> set[str]:
    """Paths of the results in git, those of the release; all of data/paper if git does not answer, as in an
    archive."""
    with suppress(OSError, subprocess.CalledProcessError):
        command = ["git", "--git-dir=.git", "ls-files", "data"]
        return {*subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()}
    return {*map(str, Path("data/paper").rglob("*"))}


@cache
def renderings() -> Path:
    """Folder of figures that are rendered again: build/audit, of a read-only project a temporary one."""
    return Path("build/audit" if WRITABLE else tempfile.mkdtemp())


def fault_of_result(path: str, run: Run) -> Fault | None:
    """Fault of the result of a run. path: the planned one."""
    try:
        load_provenance(path)
    except OSError as error:
        return Fault("not checked", path, format_os_error(error))
    except FormatError as error:
        if Path(path).exists():
            return Fault("edited", path, str(error).removeprefix(path).strip(": "))
        former = [(changes(run, sibling), str(sibling)) for sibling in siblings(path)]
        if not former:
            return Fault("missing", path, "it is not there")
        differing, nearest = min(former, key=lambda pair: len(pair[0]))
        return Fault(
            "stale", nearest, ", ".join(differing) + "; it is of the release" * (nearest in tracked())
        )
    return None


def changes(run: Run, sibling: Path) -> list[str]:
    """Options and sources that differ between a run and a former result."""
    try:
        former = load_provenance(sibling)
    except (FormatError, OSError) as error:
        return [str(error)]
    was, now = options_of(former["option_words"]), options_of(run.options_text)
    differing = [f"it has {option}" for option in was if option not in now]
    differing += [f"planned is {option}" for option in now if option not in was]
    if sources_changed(former):
        differing.append(f"sources of {run.program} have changed")
    return differing


class Product:
    """Files of a panel or of the report, and their record."""

    def __init__(self, plan: dict[str, Panel], name: str, quality: str) -> None:
        self.plan, self.name, self.quality = plan, name, quality
        self.path = Path(record_of(plan, name, quality))  # of the record
        self.record = read_record(self.path)

    @property
    def shown(self) -> str:
        """Path of its first file, which stands for all."""
        return files_of(self.plan, self.name, self.quality)[0]

    def is_made(self) -> bool:
        """Whether there is a file of it, also of a former one."""
        return Path(self.shown).exists() or bool(siblings(self.path))

    def fault(self, render: bool) -> Fault | None:
        """render: also render, in a folder where files stay that differ."""
        if not self.record:
            return self._fault_without_record()
        for kind, digest in self.record["files"].items():
            path = f"{stem_of(self.name, self.quality)}.{kind}"
            if not Path(path).exists():
                return Fault("missing", path, "it is not there")
            if hash_if_readable(path) != digest:
                return Fault("edited", path, f"it differs from its hash in {self.path}; remove it")
        return self._fault_of_rendering() if render else None

    def changes(self, former: Mapping[str, str]) -> str:
        """What differs from the parents of a former product."""
        if self.name == REPORT:
            return "other results, figures or sources"
        panel = self.plan[self.name]
        sources = sources_of_panel(panel.script, panel.reads)
        results = {path for path in former if path.endswith(".h5") and path not in sources}
        paths = dict.fromkeys([*sources, *(path for path in former if path not in results)])
        changed = [path for path in paths if sources.get(path) != former.get(path)]
        present = {*data_of(self.plan, self.name, self.quality)}
        return f"changed: {', '.join(changed + ['results'] * (results != present))}"

    def _fault_without_record(self) -> Fault:
        if self.path.exists():
            return Fault("edited", str(self.path), "it is damaged; remove it")
        former = next((known for path in siblings(self.path) if (known := read_record(path))), None)
        if former is None and self.name != REPORT:
            return Fault("missing", str(self.path), "it is not there")
        return Fault("stale", self.shown, self.changes((former or {}).get("parents", {})))

    def _fault_of_rendering(self) -> Fault | None:
        again = renderings() / self.quality / self.name
        job = replace(rendering_of(self.plan, self.name, self.quality), stem=str(again))
        command = [".venv/bin/python", "-m", "workflow.lib.render", job.json]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            return Fault("not checked", self.shown, f"rendering fails: {done.stderr.strip()[-200:]}")
        for kind, digest in self.record["files"].items():
            path, rendered = f"{stem_of(self.name, self.quality)}.{kind}", again.with_suffix(f".{kind}")
            if hash_if_readable(str(rendered)) != digest:
                from workflow.lib.save import renderer  # noqa: PLC0415  0.5 s, for matplotlib

                if (former := self.record["renderer"]) != (here := renderer()):
                    return Fault("not checked", path, f"rendered with {former}, this is {here}")
                return Fault("edited", path, f"rendering it again gives other bytes: compare {rendered}")
            rendered.unlink()
        return None


def check(plan: dict[str, Panel], names: list[str], quality: str, render: bool) -> list[Fault]:
    """Faults of the figures of panels and of the results that they plot. A figure whose results do not
    hold is not rendered."""
    runs, products = runs_of(plan, names, quality), [Product(plan, name, quality) for name in names]
    plotted = {
        path: digest for product in products for path, digest in product.record.get("parents", {}).items()
    }
    # A result that has the bytes of when it was plotted was checked then; to check all values takes ten times
    # as long.
    unknown = {path: run for path, run in runs.items() if plotted.get(path) != hash_if_readable(path)}
    results = {path: fault for path, run in unknown.items() if (fault := fault_of_result(path, run))}
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        usable = [render and not {*results} & {*data_of(plan, name, quality)} for name in names]
        figures = threads.map(Product.fault, products, usable)
    return [*results.values(), *filter(None, figures)]


def print_doubts(doubts: Mapping[str, list[str]]) -> None:
    """Names doubtful runs with the reasons, a line for each panel and reason."""
    alike = defaultdict(list)
    for path, reasons in doubts.items():
        alike[panel_of(path), "; ".join(reasons)].append(run_of(path))
    for (panel, reason), runs in sorted(alike.items(), key=lambda item: item[0][0] in SHORT):
        short = " (too short on purpose)" * (panel in SHORT)
        print(f"doubtful: {panel}{short}: {reason}: {', '.join(runs)}")


def main(options: argparse.Namespace) -> int:
    quality, plan = options.quality, options.plan
    names = options.panels or [*plan]
    if options.render and WRITABLE:
        lock_products()  # build/audit is one folder
    made = [name for name in names if Product(plan, name, quality).is_made()]
    faults, alike = check(plan, made, quality, options.render), defaultdict(list)
    report = None if options.panels else Product(plan, REPORT, quality)
    if report and report.is_made() and (fault := report.fault(render=False)):
        faults.append(fault)
    for fault in faults:
        alike[fault.state, fault.reason, os.path.dirname(fault.path)].append(fault.path)
    for (state, reason, _), (first, *more) in alike.items():
        print(f"{state}: {first}{f' and {len(more)} more' if more else ''}: {reason}")
    print_doubts(doubtful(plan, made, quality))
    if rest := [name for name in names if name not in made]:
        print(f"Not made at quality {quality}: {', '.join(rest)}")
    states = Counter(fault.state for fault in faults)
    listed = ", ".join(f"{number} {state}" for state, number in states.items()) or "all hold"
    if made:
        print(
            f"{len(made)} panel{'s' * (len(made) > 1)} with {len(runs_of(plan, made, quality))} results: {listed}"
        )
    broken = states.keys() - {"not checked"}
    if broken & {"stale", "missing"}:
        print(f"make report {options.effort} makes stale and missing files")
    return 1 if broken else 3 if states or not made else 0

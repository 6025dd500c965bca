"""Checks results and figures against the present options, sources and packages (`make audit`; `make status` renders nothing).

Results and figures must be unmodified and current, and a figure that is rendered again must have equal bytes. A panel without figure
files is not made: some of its results may exist, as other panels plot them.

Exit status: 0, 1 if something is stale, edited or missing, 3 if something could not be checked or nothing is made.
"""

import argparse
import os
import subprocess
from collections import Counter, defaultdict
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import NamedTuple

from workflow.lib.files import in_one_line
from workflow.lib.identity import named_identity, sha256, siblings, sources_of_panel, stated
from workflow.lib.load import FormatError, load_provenance
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import Panel, Run, data_of, rendering_command, report_stem, runs_of, stem_of
from workflow.pipeline.publish import FIGURES, RENDERED, copies, read_record
from workflow.pipeline.sources import source_hash


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
    """Paths of the results in git, those of the release; none in a copy without it."""
    command = ["git", "--git-dir=.git", "ls-files", "data"]
    return {*subprocess.run(command, capture_output=True, text=True, check=False).stdout.splitlines()}


def fault_of_result(path: str, run: Run) -> Fault | None:
    """Fault of the result of a run. path: the planned one."""
    try:
        load_provenance(path)
    except OSError as error:
        return Fault("not checked", path, in_one_line(error))
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
    was, now = options_of(former["words"]), options_of(run.options_text)
    differing = [f"it has {option}" for option in was if option not in now]
    differing += [f"planned is {option}" for option in now if option not in was]
    if former["source_hash"] != source_hash(run.program):
        differing.append(f"sources of {run.program} have changed")
    return differing


class FigureFiles:
    """Figure of a panel: in the store, under its present identity, and the copy that is shown."""

    def __init__(self, plan: dict[str, Panel], name: str, quality: str) -> None:
        self.panel, self.shown = plan[name], f"{FIGURES}/{quality}/{name}"
        self.data, self.stem = data_of(plan, name, quality), stem_of(plan, name, quality)
        self.record = read_record(f"{self.stem}.json")
        self.statement = (name, quality, named_identity(self.stem))

    def is_made(self) -> bool:
        """Whether there is a file of it, also of a former one."""
        return Path(f"{self.shown}.pdf").exists() or bool(siblings(f"{self.stem}.json"))

    def fault(self, render: bool) -> Fault | None:
        """render: also render in build/audit, where files stay that differ."""
        if not self.record:
            return self._fault_without_record()
        for kind, digest in self.record["files"].items():
            for path in (f"{self.stem}.{kind}", f"{self.shown}.{kind}"):
                if not Path(path).exists():
                    return Fault("missing", path, "it is not there")
                content = Path(path).read_bytes()
                if sha256(content) != digest:
                    if (states := stated(content)) not in (None, self.statement):
                        reason = f"its identity is {states[2]}, that of other sources or results"
                        return Fault("stale", path, f"{reason}; make report writes the present one")
                    remedy = "remove it" if path.startswith(RENDERED) else "make report writes it again"
                    return Fault("edited", path, f"it differs from its hash in {self.stem}.json; {remedy}")
        return self._fault_of_rendering() if render else None

    def changes(self, former: Mapping[str, str]) -> str:
        """What differs from the parents of a former figure."""
        sources = sources_of_panel(self.panel.script, self.panel.reads)
        results = {path for path in former if path.endswith(".h5") and path not in sources}
        paths = dict.fromkeys([*sources, *(path for path in former if path not in results)])
        changed = [path for path in paths if sources.get(path) != former.get(path)]
        return f"changed: {', '.join(changed + ['results'] * (results != {*self.data}))}"

    def _fault_without_record(self) -> Fault:
        record = f"{self.stem}.json"
        if Path(record).exists():
            return Fault("edited", record, "it is damaged; remove it")
        former = next((known["parents"] for path in siblings(record) if (known := read_record(path))), None)
        if former is None:
            return Fault("missing", record, "it is not there")
        return Fault("stale", f"{self.shown}.pdf", self.changes(former))

    def _fault_of_rendering(self) -> Fault | None:
        name, quality, _ = self.statement
        rendered = Path("build/audit", quality, name)
        command = rendering_command(self.panel, str(rendered), self.data)
        done = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
        if done.returncode:
            return Fault("not checked", f"{self.shown}.pdf", f"rendering fails: {done.stderr.strip()[-200:]}")
        for copy, again in copies(rendered).items():
            if copy.read_bytes() != again.read_bytes():
                from workflow.lib.save import renderer  # noqa: PLC0415  0.5 s, for matplotlib

                if (former := self.record["renderer"]) != (here := renderer()):
                    return Fault("not checked", str(copy), f"rendered with {former}, this is {here}")
                return Fault("edited", str(copy), f"rendering it again gives other bytes: compare {again}")
            again.unlink()
        return None


def check(plan: dict[str, Panel], names: list[str], quality: str, render: bool) -> list[Fault]:
    """Faults of the figures of panels and of the results that they plot. A figure whose results do not hold is not rendered."""
    runs, pictures = runs_of(plan, names, quality), [FigureFiles(plan, name, quality) for name in names]
    plotted = {
        path: digest for picture in pictures for path, digest in picture.record.get("parents", {}).items()
    }
    # A result that has the bytes of when it was plotted was checked then; to check all values takes ten times as long.
    unknown = {path: run for path, run in runs.items() if plotted.get(path) != hash_if_readable(path)}
    results = {path: fault for path, run in unknown.items() if (fault := fault_of_result(path, run))}
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        usable = [render and not {*results} & {*picture.data} for picture in pictures]
        figures = threads.map(FigureFiles.fault, pictures, usable)
    return [*results.values(), *filter(None, figures)]


def fault_of_report(plan: dict[str, Panel], quality: str) -> Fault | None:
    """Fault of the published report, if there is one."""
    page, current = Path(FIGURES, quality, "report.html"), Path(f"{report_stem(plan, quality)}.html")
    if not page.exists():
        return None
    content = page.read_bytes()
    if current.exists() and content == current.read_bytes():
        return None
    if not current.exists() or any(content == former.read_bytes() for former in siblings(current)):
        reason = "other results, figures or sources; make report makes the present one"
        return Fault("stale", str(page), reason)
    return Fault("edited", str(page), f"it differs from {current}; make report writes it again")


def main(options: argparse.Namespace) -> int:
    quality, plan = options.quality, options.plan
    names = options.panels or [*plan]
    if options.render:
        lock_products()  # build/audit is one folder
    made = [name for name in names if FigureFiles(plan, name, quality).is_made()]
    faults, alike = check(plan, made, quality, options.render), defaultdict(list)
    if not options.panels and (fault := fault_of_report(plan, quality)):
        faults.append(fault)
    for fault in faults:
        alike[fault.state, fault.reason, os.path.dirname(fault.path)].append(fault.path)
    for (state, reason, _), (first, *more) in alike.items():
        print(f"{state}: {first}{f' and {len(more)} more' if more else ''}: {reason}")
    if rest := [name for name in names if name not in made]:
        print(f"Not made at quality {quality}: {', '.join(rest)}")
    states = Counter(fault.state for fault in faults)
    listed = ", ".join(f"{number} {state}" for state, number in states.items()) or "all hold"
    if made:
        print(f"{len(made)} panels with {len(runs_of(plan, made, quality))} results: {listed}")
    broken = states.keys() - {"not checked"}
    if broken & {"stale", "missing"}:
        print(f"make report {options.effort} makes stale and missing files")
    return 1 if broken else 3 if states or not made else 0

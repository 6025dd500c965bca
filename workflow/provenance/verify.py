"""Makes a sample of the products again and compares.

Programs are built afresh from the sources. Equal builds have to give the same bytes; another compiler or library
results within errors, another kind of machine pictures that are equal but for rounding. The verdicts are kept in
data/<quality>/verification.json; what has none is sampled first.
"""

import argparse
import hashlib
import json
import math
import signal
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from workflow.lib.load import FormatError
from workflow.lib.places import is_limit
from workflow.lib.plan import load_plan, outputs_of, panel_named
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance.fresh_build import BuildError, FreshBuild
from workflow.provenance.job import Job
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.printable import printable
from workflow.provenance.redo import RedoError, agreement, redrawn, same_bytes, simulate, workplace
from workflow.provenance.repository import ROOT, machine, write_whole

BAD_INPUT = 2  # exit status

Verdict = tuple[bool, str]  # whether the same is made again, and in what sense


def drawing_verdict(job: Job, differing: dict[str, bool]) -> Verdict:
    if wrong := [path for path, rounded in differing.items() if not rounded]:
        return False, f"other bytes in {', '.join(wrong)}"
    return True, "the same but for rounding" if differing else "the same bytes"


def run_verdict(job: Job, fresh: FreshBuild, recorded: dict[str, Any], folder: Path) -> Verdict:
    """Raises RedoError or FormatError."""
    if fault := fresh.fault(job, recorded):
        return False, fault
    (path,) = job.outputs
    again = simulate(job, fresh.programs, folder)
    if same_bytes(ROOT / path, again):
        return True, "the same bytes"
    if fresh.identity(job.tool)["build_id"] == job.build_id:
        return False, f"other bytes in {path}"
    within, words = agreement(ROOT / path, again)
    return within, f"{words}, by another compiler or other libraries"


def sample(lock: Lock, names: list[str], share: float, verdicts: dict[str, Any]) -> list[str]:
    """Those not yet verified first, in an order that only the names fix."""

    def order(name: str) -> tuple[bool, str]:
        verified = verdicts.get(name, {}).get("outputs") == lock.jobs[name].outputs
        return verified, hashlib.sha256(name.encode()).hexdigest()

    return sorted(names, key=order)[: math.ceil(share * len(names))]


class Verdicts(dict[str, dict[str, Any]]):
    """By job; kept beside the lock where that can be written."""

    def __init__(self, quality: str) -> None:
        self.path = Lock.path(quality).with_name("verification.json")
        self.unwritten: str | None = None
        try:
            read = json.loads(self.path.read_text()) if self.path.is_file() else {}
            super().__init__({name: one for name, one in read.items() if isinstance(one, dict)})
        except (OSError, ValueError, AttributeError, RecursionError):
            super().__init__()

    def keep(self, name: str, job: Job, verdict: Verdict) -> None:
        self[name] = {"outputs": job.outputs, "same": verdict[0], "verdict": verdict[1], "machine": machine()}
        try:
            write_whole(self.path, json.dumps(self, indent=1, sort_keys=True) + "\n")
        except OSError as error:
            self.unwritten = f"The verdicts are not kept: {self.path.relative_to(ROOT)}: {error.strerror}"


def verify(lock: Lock, names: Iterable[str], verdicts: Verdicts) -> bool:
    """Prints a line per job; true if none differs. Raises BuildError."""
    jobs = {name: lock.jobs[name] for name in names}
    programs = {job.tool for job in jobs.values() if not job.is_drawing}
    same = True
    with workplace() as place:
        fresh = FreshBuild.of(programs, place / "build") if programs else FreshBuild(place / "build")
        for name, job in jobs.items():
            with tempfile.TemporaryDirectory(dir=place) as folder:
                verdict = verdict_on(lock, name, fresh, Path(folder))
            verdicts.keep(name, job, verdict)
            print(printable(f"{name}: {verdict[1]}"), flush=True)
            same = same and verdict[0]
    return same


def verdict_on(lock: Lock, name: str, fresh: FreshBuild, folder: Path) -> Verdict:
    job = lock.jobs[name]
    try:
        if {*job.outputs} != {*outputs_of(lock.quality, name)}:
            return False, f"the lock names other products of it: {', '.join(job.outputs)}"
        if lacking := [path for path in job.outputs if not (ROOT / path).is_file()]:
            return False, f"{lacking[0]} is missing or not a file"
        if job.is_drawing:
            return drawing_verdict(job, redrawn(job, folder))
        return run_verdict(job, fresh, lock.builds.get(job.build, {}), folder)
    except (RedoError, FormatError, AttributeError, OSError) as error:  # of a forged file, too
        if is_limit(error):
            raise
        return False, str(error)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--sample", type=float, default=0.1, help="share of the jobs")
    parser.add_argument("--panel", help="of this panel only")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))  # leaves no build behind
    if not 0 < options.sample <= 1:
        parser.error(f"SAMPLE={options.sample} is not a share: choose a number above 0 and up to 1")
    try:
        plan = load_plan(options.quality)
        if options.panel:
            panel_named(plan, options.panel)
        lock = Lock.read(options.quality)
        if lock.quality != options.quality:
            raise LockError(f"data/{options.quality}/lock.json is the lock of quality {lock.quality}")
        names = [name for name in lock.jobs if options.panel in (None, name.split("/")[0])]
        if not names:
            raise LockError(f"nothing of {options.panel or options.quality} has been made yet")
        verdicts = Verdicts(options.quality)
        chosen = sample(lock, names, options.sample, verdicts)
        same = verify(lock, chosen, verdicts)
    except ConfigurationError as error:
        print(f"make verify: {error}", file=sys.stderr)
        sys.exit(BAD_INPUT)
    except (LockError, BuildError) as error:
        sys.exit(printable(f"make verify: {error}"))
    print(f"Looked at {len(chosen)} of {len(lock.jobs)} jobs")
    if verdicts.unwritten:
        print(verdicts.unwritten)
    sys.exit(0 if same else "make verify: some products cannot be made again as they are")


if __name__ == "__main__":
    main()

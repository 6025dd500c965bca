"""Makes a sample of the products again and compares: the same bytes on the same kind of machine, within errors
on another. The verdicts are kept in data/<quality>/verification.json; what has none is sampled first.
"""

import argparse
import hashlib
import json
import math
import sys
import tempfile
from pathlib import Path

from workflow.provenance.lock import Job, Lock, LockError
from workflow.provenance.redo import RedoError, disagreement, redrawn, same_bytes, simulate
from workflow.provenance.repository import ROOT, machine

SIGNIFICANCE = 1e-3  # of a deviation of independent random numbers


def verdict(job: Job, folder: Path) -> tuple[bool, str]:
    """Whether the job makes again what it made, and in what sense. Raises RedoError."""
    return (
        drawing_verdict(job, redrawn(job, folder))
        if job.is_drawing
        else run_verdict(job, simulate(job, folder))
    )


def drawing_verdict(job: Job, differing: dict[str, bool]) -> tuple[bool, str]:
    if wrong := [path for path, rounded in differing.items() if not rounded]:
        return False, f"other {'bytes' if job.machine == machine() else 'numbers'} in {', '.join(wrong)}"
    return True, "the same table but for rounding" if differing else "the same bytes"


def run_verdict(job: Job, again: Path) -> tuple[bool, str]:
    (path,) = job.outputs
    if same_bytes(ROOT / path, again):
        return True, "the same bytes"
    if job.machine == machine():
        return False, f"other bytes in {path}"
    largest, probability = disagreement(ROOT / path, again)
    within = probability > SIGNIFICANCE
    return (
        within,
        f"{'' if within else 'not '}within errors: largest |z| {largest:.2g}, p = {probability:.2g}",
    )


def sample(lock: Lock, names: list[str], share: float, verdicts: dict) -> list[str]:
    """Those not yet verified first, in an order that only the names fix."""

    def order(name: str) -> tuple[bool, str]:
        verified = verdicts.get(name, {}).get("outputs") == lock.jobs[name].outputs
        return verified, hashlib.sha256(name.encode()).hexdigest()

    return sorted(names, key=order)[: math.ceil(share * len(names))]


def verify(quality: str, share: float, only: str | None) -> bool:
    """Prints a line per job; true if none differs. Raises LockError."""
    lock = Lock.read(quality)
    record = Lock.path(quality).with_name("verification.json")
    verdicts = json.loads(record.read_text()) if record.is_file() else {}
    names = [name for name in lock.jobs if only in (None, name.split("/")[0])]
    names = sample(lock, names, share, verdicts)
    if not names:
        raise LockError(f"nothing of {only or quality} has been made yet")
    for name in names:
        job = lock.jobs[name]
        with tempfile.TemporaryDirectory() as folder:
            try:
                same, words = verdict(job, Path(folder))
            except (RedoError, OSError) as error:
                same, words = False, str(error)
        verdicts[name] = {"outputs": job.outputs, "same": same, "verdict": words, "machine": machine()}
        record.write_text(json.dumps(verdicts, indent=1, sort_keys=True) + "\n")
        print(f"{name}: {words}", flush=True)
    return all(verdicts[name]["same"] for name in names)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--sample", type=float, default=0.1, help="share of the jobs")
    parser.add_argument("--panel", help="of this panel only")
    options = parser.parse_args()
    if not 0 < options.sample <= 1:
        parser.error(f"SAMPLE={options.sample} is not a share: choose a number above 0 and up to 1")
    try:
        same = verify(options.quality, options.sample, options.panel)
    except LockError as error:
        sys.exit(f"make verify: {error}")
    sys.exit(0 if same else "make verify: some products cannot be made again as they are")


if __name__ == "__main__":
    main()

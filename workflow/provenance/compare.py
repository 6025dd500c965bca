"""Compares runs with those that they replaced, or those of another seed or number of replicas with the quality's own.

Prints a line per run: the same bytes, within errors, or not; status 1 if one is not.
"""

import argparse
import sys
from pathlib import Path

from workflow.lib.load import FormatError
from workflow.lib.plan import Quality, data_path, load_plan, with_used
from workflow.provenance.redo import agreement, same_bytes
from workflow.provenance.repository import ROOT
from workflow.provenance.stale import REPLACED


def verdict(one: Path, other: Path) -> tuple[bool, str]:
    """Whether two files of a run agree, and in what sense."""
    if not other.is_file():
        return True, f"nothing to compare with: {other.relative_to(ROOT)} is missing"
    if same_bytes(one, other):
        return True, "the same bytes"
    try:
        within, words = agreement(one, other)
    except FormatError as error:
        return False, f"cannot be compared: {error}"
    return within, f"other bytes, {words}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="only the runs that this panel shows")
    options = parser.parse_args()
    quality, plan = Quality.of(options.quality), load_plan(options.quality)
    own = quality.name == quality.base
    shared = (
        ""
        if own or quality.seed is not None
        else "; the first replicas are the same, so deviations are small"
    )
    print(f"Compared with {REPLACED if own else f'data/{quality.base}'}{shared}:")
    agree: list[bool] = []
    for panel in with_used(plan, options.panel) if options.panel else plan.values():
        for run in panel.runs:
            path = data_path(quality.name, panel.name, run.name)
            other = f"{REPLACED}/{path}" if own else data_path(quality.base, panel.name, run.name)
            within, words = verdict(ROOT / path, ROOT / other)
            agree.append(within)
            print(f"  {panel.name}/{run.name}: {words}")
    if not all(agree):
        sys.exit(
            f"{agree.count(False)} of {len(agree)} runs do not agree with those that they are compared with."
        )


if __name__ == "__main__":
    main()

"""Prints the provenance of a product or a copy of it: its parents down to sources, parameters and seeds.

Exit status: 0 if the hash of the file is in the record of a panel here, or a result is unmodified, and no parent differs here; 1 if
not; 2 for bad input.
"""

import argparse
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from workflow.lib.figure_metadata import MetadataError, Parents, embedded, read_panel
from workflow.lib.files import ROOT, file_hash
from workflow.lib.load import FormatError, load_statements
from workflow.lib.record import records_of
from workflow.provenance.build_id import sources_of_program

GALLERY = "docs/gallery/gallery"  # path of the record of the gallery, without identity and suffix
SHORT = 16  # printed digits of a hash
FEW = 3  # printed entries of a list without --full


OTHER, MISSING, SAME = "other here", "missing here", "same here"  # in the order of printing


def state(path: str, digest: str) -> str:
    here = file_hash(ROOT / path) if (ROOT / path).is_file() else None
    return {None: MISSING, digest: SAME}.get(here, OTHER)


def build_lines(build: dict[str, Any]) -> Iterator[str]:
    try:
        same = sources_of_program(build["program"]) == build["source_hash"]
    except OSError:
        same = False
    yield f"  program {build['program']}: {build['compiler']}, {build['flags']}; {build['libraries']}"
    yield f"    sources {build['source_hash'][:SHORT]}  {SAME if same else OTHER}"


def result_lines(stated: dict[str, Any], parameters: dict[str, Any]) -> Iterator[str]:
    values = ", ".join(f"{name} {value}" for name, value in parameters.items())
    yield f"  parameters: {values}"
    yield f"  random numbers: {stated['streams']}"
    yield from build_lines(stated)


def parent_lines(parents: Parents, few: int | None) -> Iterator[str]:
    """All parents that differ here, then a few of the others."""
    yield f"  panel {parents.panel} at quality {parents.quality}, identity {parents.identity}"
    yield f"  Python {parents.python}"
    inputs = {path: (digest, "") for path, digest in parents.sources.items()}
    inputs |= {path: (result["sha256"], f", seed {result['seed']}") for path, result in parents.data.items()}
    by_state: dict[str, list[str]] = {OTHER: [], MISSING: [], SAME: []}
    for path, (digest, seed) in inputs.items():
        status = state(path, digest)
        by_state[status].append(f"  {path}  {digest[:SHORT]}  {status}{seed}")
    for status, lines in by_state.items():
        shown = None if status == OTHER else few
        yield from lines[:shown]
        if hidden := len(lines) - len(lines[:shown]):
            yield f"  and {hidden} more that are {status}, shown with FULL=yes"
    for build in parents.builds.values():
        yield from build_lines(build)
    if by_state[OTHER]:
        yield f"Parents have changed: make panel PANEL={parents.panel} QUALITY={parents.quality} makes the panel from those here"


def records() -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Hash, path and record of the panel of every figure file here, then of the smaller pictures and the tables in the gallery."""
    for path in sorted((ROOT / "figures").glob("*/*.json")):
        if record := _record(path):
            yield from (
                (digest, str(path.with_name(name).relative_to(ROOT)), record)
                for name, digest in record["files"].items()
            )
    for path in records_of(ROOT / GALLERY):
        for name, digest in json.loads(path.read_text("utf-8"))["files"].items():
            copied = path.parent / name
            if copied.suffix != ".json" and (record := _record(copied.with_suffix(".json"))):
                yield digest, str(copied.relative_to(ROOT)), record


def _record(path: Path) -> dict[str, Any] | None:
    """Record of a panel; None if it cannot be read."""
    try:
        return read_panel(path)
    except (MetadataError, OSError):
        return None


def explain(path: Path, few: int | None) -> tuple[bool, list[str]]:
    """Whether the file is an unmodified product, and the lines to print. Raises FormatError, MetadataError, OSError."""
    digest = file_hash(path)
    if path.suffix == ".h5":
        provenance, parameters, whole = load_statements(path)
        first = f"{path.name} is {'unmodified' if whole else 'edited or damaged'}"
        return whole, [first, *result_lines(provenance, parameters)]
    matches = [(product, record) for recorded, product, record in records() if recorded == digest]
    for product, record in matches[:1]:
        clean = {True: "clean", False: "with uncommitted changes", None: "no repository"}[record["clean"]]
        first = f"{path.name} is {product}, rendered at commit {str(record['commit'])[:SHORT]} ({clean})"
        return True, [first, *parent_lines(record["parents"], few)]
    first = f"{path.name} belongs to no panel here: edited, or rendered elsewhere. Its parents:"
    stated = embedded(path)
    if path.suffix != ".csv":
        return False, [first, *parent_lines(Parents.parse(stated), few)]
    for _, product, record in records():  # a CSV has only the identity
        if record["parents"].identity == stated:
            return False, [f"{first} those of {product}", *parent_lines(record["parents"], few)]
    return False, [f"{first} those of identity {stated}, of no panel here"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--full", action="store_true", help="all sources and results")
    options = parser.parse_args()
    try:
        unmodified, lines = explain(options.file, None if options.full else FEW)
    except OSError as error:
        print(f"{options.file}: {error.strerror}", file=sys.stderr)
        sys.exit(2)
    except (FormatError, MetadataError) as error:
        sys.exit(str(error))
    print(*lines, sep="\n")
    sys.exit(0 if unmodified and not any(OTHER in line for line in lines) else 1)


if __name__ == "__main__":
    main()

"""Prints where a file comes from: a result, a figure or its table, or a copy of one anywhere.

Exit status: 0 if the file is unmodified, 1 if it is edited or states nothing, 3 if its record is not here.
"""

import argparse
from pathlib import Path

from workflow.identity import content_hash, result_identity, sha256, stated
from workflow.lib.load import FormatError, load_provenance
from workflow.plan import QUALITIES, Quality, plans_of, runs_of
from workflow.publish import STORE, read_record

HDF5 = b"\x89HDF"  # first bytes of a file


def print_panel(panel: str, quality: str) -> None:
    print(f"panel {panel}, quality {quality}: make panel PANEL={panel} {Quality.of(quality).arguments}")


def explain_result(path: Path) -> int:
    origin = load_provenance(path)
    program, words = origin["program"], origin["words"]
    for quality, plan in (named for base in QUALITIES for named in plans_of(base).items()):
        for planned, run in runs_of(plan, plan, quality).items():
            if (run.program, run.words) == (program, words):
                print_panel(Path(planned).parent.name, quality)
    print(f"{program} {words}")
    print(f"unmodified, identity {result_identity(program, words, origin['source_hash'])}")
    print(f"compiled by {origin['compiler']} with {origin['libraries']}")
    return 0


def explain_figure(content: bytes) -> int:
    if not (statement := stated(content)):
        print("It states no panel: it is no file of a panel, or another program has written it again")
        return 1
    panel, quality, identity = statement
    print_panel(panel, quality)
    path = f"{STORE}/{quality}/{panel}.{identity}.json"
    if not (record := read_record(path)):
        print(f"identity {identity}, of which there is no record here")
        return 3
    for parent, digest in record["parents"].items():
        if parent.endswith(".h5"):
            print_command(parent)
        elif not (Path(parent).exists() and content_hash(parent) == digest):
            print(f"{parent} is another here")
    edited = sha256(content) not in record["files"].values()
    print(f"{'edited' if edited else 'unmodified'}, made from {len(record['parents'])} files: {path}")
    print(f"commit {record['commit'] or 'unknown'}, rendered by {record['renderer']}")
    return int(edited)


def print_command(path: str) -> None:
    """Path of a result, and the command of its program."""
    try:
        origin = load_provenance(path)
        print(f"{path}: {origin['program']} {origin['words']}")
    except (FormatError, OSError) as error:
        print(error)


def main(options: argparse.Namespace) -> int:
    content = Path(options.file).read_bytes()
    try:
        if content.startswith(HDF5):
            return explain_result(Path(options.file))
        return explain_figure(content)
    except FormatError as error:
        print(error)
        return 1

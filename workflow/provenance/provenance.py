"""Prints where a file comes from: a result, a figure or its table, or a copy of one anywhere. FULL=yes: with hashes and versions.

Exit status: 0 if the file is unmodified, 1 if it is edited or states nothing, 3 if its record is not here.
"""

import argparse
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from workflow.identity import content_hash, result_identity, sha256, stated
from workflow.lib.load import FormatError, load_provenance
from workflow.plan import QUALITIES, Quality, plans_of, runs_of
from workflow.provenance.audit import options_of
from workflow.publish import STORE, read_record

HDF5 = b"\x89HDF"  # first bytes of a file


def print_panel(panel: str, quality: str) -> None:
    print(f"panel {panel}, quality {quality}: make panel PANEL={panel} {Quality.of(quality).arguments}")


def print_results(paths: Iterable[str]) -> None:
    """Program and options that results have in common, then those of each."""
    words = {}
    for path in paths:
        try:
            origin = load_provenance(path)
            words[path] = [origin["program"], *options_of(origin["words"])]
        except (FormatError, OSError) as error:
            print(error)
    common = [word for word in next(iter(words.values()), []) if all(word in own for own in words.values())]
    print(*common)
    for path, own in words.items():
        print(f"  {path}:", *(word for word in own if word not in common))


def print_details(details: dict[str, Any]) -> None:
    print(*(f"{name}: {value}" for name, value in details.items()), sep="\n")


def explain_result(path: Path, full: bool) -> int:
    origin = load_provenance(path)
    program, words = origin["program"], origin["words"]
    for quality, plan in (named for base in QUALITIES for named in plans_of(base).items()):
        for planned, run in runs_of(plan, plan, quality).items():
            if (run.program, run.words) == (program, words):
                print_panel(Path(planned).parent.name, quality)
    print(f"{program} {words}")
    print(f"unmodified, identity {result_identity(program, words, origin['source_hash'])}")
    if full:
        print_details(origin)
    return 0


def explain_figure(content: bytes, full: bool) -> int:
    if not (statement := stated(content)):
        print("It states no panel: it is no file of a panel, or another program has written it again")
        return 1
    panel, quality, identity = statement
    print_panel(panel, quality)
    record = read_record(f"{STORE}/{quality}/{panel}.{identity}.json")
    if not record:
        print(f"identity {identity}, of which there is no record here")
        return 3
    edited, parents = sha256(content) not in record["files"].values(), record["parents"]
    print_results(path for path in parents if path.endswith(".h5"))
    print(f"{'edited' if edited else 'unmodified'}, made from {len(parents)} files")
    for path, digest in parents.items():
        if not path.endswith(".h5") and not (Path(path).exists() and content_hash(path) == digest):
            print(f"{path} is another here")
    if full:
        print_details({name: record[name] for name in ("identity", "commit", "renderer")} | parents)
    return int(edited)


def main(options: argparse.Namespace) -> int:
    content = Path(options.file).read_bytes()
    try:
        if content.startswith(HDF5):
            return explain_result(Path(options.file), options.full)
        return explain_figure(content, options.full)
    except FormatError as error:
        print(error)
        return 1

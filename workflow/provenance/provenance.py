"""Prints where a file comes from: a result, a figure or its table, or a copy of one anywhere.

Exit status: 0 if the file is unmodified, 1 if it is edited or states nothing, 3 if its record is not here.
"""

import argparse
from collections.abc import Iterable
from pathlib import Path

from workflow.identity import content_hash, result_identity, sha256, stated
from workflow.lib.load import FormatError, load
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
            origin = load(path).provenance
            words[path] = [origin["program"], *options_of(origin["words"])]
        except (FormatError, OSError) as error:
            print(error)
    common = [word for word in next(iter(words.values()), []) if all(word in own for own in words.values())]
    print(*common)
    for path, own in words.items():
        print(f"  {path}:", *(word for word in own if word not in common))


def explain_result(path: Path, full: bool) -> int:
    origin = load(path).provenance
    program, words = origin["program"], origin["words"]
    for quality, plan in (named for base in QUALITIES for named in plans_of(base).items()):
        for planned, run in runs_of(plan, plan, quality).items():
            if (run.program, run.words) == (program, words):
                print_panel(Path(planned).parent.name, quality)
                print(f"present name {planned}")
    print(f"{program} {words}")
    print(f"unmodified, identity {result_identity(program, words, origin['source_hash'])}")
    print(*(f"{name}: {value}\n" for name, value in origin.items() if full), sep="", end="")
    return 0


def explain_figure(content: bytes, full: bool) -> int:
    if not (statement := stated(content)):
        print(
            "This is no file of a panel, or another program wrote it again: it states no panel and identity"
        )
        return 1
    panel, quality, identity = statement
    print_panel(panel, quality)
    records = map(read_record, (f"{STORE}/{quality}/{panel}.{identity}.json", f"docs/gallery/{panel}.json"))
    record = next((record for record in records if record.get("identity") == identity), None)
    if not record:
        print(f"identity {identity}, of which there is no record here")
        return 3
    edited, parents = sha256(content) not in record["files"].values(), record["parents"]
    print_results(path for path in parents if path.endswith(".h5"))
    print(
        f"{'edited' if edited else 'unmodified'}, identity {identity}, commit {record['commit'] or 'unknown'}"
    )
    print(record["renderer"])
    for path in (path for path in parents if full or not path.endswith(".h5")):
        same = Path(path).exists() and content_hash(path) == parents[path]
        print(f"{path}, {'the same' if same else 'another'} here", f"sha256 {parents[path]}" if full else "")
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

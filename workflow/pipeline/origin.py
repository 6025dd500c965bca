"""Prints where a file comes from: a result, a figure or its table, or a copy of one anywhere.

The first line states whether it is unmodified, and fresh here. Exit status: 0 if the file is unmodified, 1 if
it is edited or states nothing, 2 if there is no such file, 3 if its record is not here.
"""

from contextlib import suppress
from pathlib import Path
from typing import Any

from workflow.lib.identity import named_identity, result_identity, sha256
from workflow.lib.load import FormatError, load_provenance
from workflow.pipeline.audit import differences
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import FIGURES, REPORT, Plan, runs_of
from workflow.pipeline.selection import QUALITIES, Selection
from workflow.pipeline.sources import sources_changed
from workflow.render.record import FORMER, SHARED, read_identity_line, read_record, record_name

HDF5 = b"\x89HDF"  # first bytes of a file


def print_panel(panel: str, selection: str) -> None:
    target = panel if panel == REPORT else f"panel PANEL={panel}"
    print(f"panel {panel}, quality {selection}: make {target} {Selection.parse(selection).arguments}")


def print_command(origin: dict[str, Any], where: str = "") -> None:
    """Command of the program of a result."""
    print(f"{where}{origin['program']} {origin['option_words']}")
    if sources_changed(origin):
        print(f"sources of {origin['program']} differ here")


def selections() -> list[str]:
    """Qualities, and those with an effort that have results here."""
    names = [*QUALITIES]
    for folder in Path("data").glob("*_*"):
        with suppress(ConfigurationError):  # a folder of the user
            names.append(Selection.parse(folder.name).name)
    return names


def explain_result(path: Path) -> int:
    origin = load_provenance(path)
    program, words = origin["program"], origin["option_words"]
    panels = []
    for selection in selections():
        for run in runs_of(Plan(selection)).values():
            if (run.program, run.options_text) == (program, words):
                panels.append((run.panel, selection))
    state = "fresh" if panels else "of no panel here"
    if sources_changed(origin):
        state = f"stale: sources of {program} have changed"
    print(f"unmodified, {state}")
    for panel, selection in panels:
        print_panel(panel, selection)
    print_command(origin)
    print(f"identity {result_identity(program, words, origin['source_hash'])}")
    print(f"compiled by {origin['compiler']} with {origin['libraries']}")
    return 0


def explain_figure(path: Path) -> int:
    content = path.read_bytes()
    if not (line := read_identity_line(content)):
        print(
            f"{path} has no panel metadata: it is no file of a panel or report, or another program rewrote it"
        )
        return 1
    panel, selection, identity = line
    plan, name = Plan(selection), record_name(panel, identity)
    known = next(
        (path for folder in (FIGURES, FORMER) if (path := Path(folder, selection, name)).exists()), Path(name)
    )
    record = read_record(known)
    planned = plan.report if panel == REPORT else plan.panels.get(panel)
    fresh = "fresh"
    if not planned:
        fresh = "stale: there is no such panel"
    elif planned.identity != identity:
        fresh = (
            f"stale: {differences(planned, record['parents']) if record else 'of other sources or results'}"
        )
    digest, files = sha256(content), record.get("files", {})
    edited = bool(record) and digest not in (
        *files.values(),
        _of_reduced(f"{FIGURES}/{selection}/{panel}", files),
    )
    state = "edited" if edited else "unmodified" if record else "not checked"
    unknown = (
        f": the record of identity {identity} is not here; this command makes that of the present sources"
    )
    print(f"{state}, {fresh}{unknown * (not record and planned is not None)}")
    if planned:
        print_panel(panel, selection)
    else:
        print(f"panel {panel}, quality {selection}")
    if not record:
        return 3
    own = ("workflow/figures/", "workflow/study/", "figures/", *SHARED)
    for parent in (parent for parent in record["parents"] if not parent.startswith(own)):
        if not parent.startswith("data/") or not named_identity(parent):
            print(f"uses {parent}")
            continue
        try:
            print_command(load_provenance(parent), f"{parent}: ")
        except (FormatError, OSError) as error:
            print(error)
    print(f"made from {len(record['parents'])} files: {known}")
    print(f"commit {record['commit'] or 'unknown'}, rendered by {record.get('renderer', 'Python')}")
    return int(edited)


def _of_reduced(stem: str, files: dict[str, str]) -> str:
    """sha256 of the picture in the gallery; empty if the original, of these files, is not here."""
    picture = Path(f"{stem}.png")
    if not picture.exists() or sha256(picture.read_bytes()) != files.get("png"):
        return ""
    from workflow.render.save import reduced  # noqa: PLC0415  0.5 s, for matplotlib

    return sha256(reduced(picture))


def origin(path: Path) -> int:
    """Returns the exit status."""
    if not path.is_file():
        print(f"{path} is not a file; give the path of a result, a figure or a copy")
        return 2
    try:
        return (explain_result if path.read_bytes().startswith(HDF5) else explain_figure)(path)
    except FormatError as error:
        print(error)
        return 1

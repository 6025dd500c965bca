"""Prints where a file comes from: a result, a figure or its table, or a copy of one anywhere.

First a summary: whether the file is unmodified, and current here; the panel and the command that makes it.
Then the results and files that it is made from. Exit status: 0 if the file is unmodified, 1 if it is edited
or has no metadata, 2 if there is no such file, 3 if it is of other sources or results, so that its bytes are
not checked.
"""

import textwrap
from contextlib import suppress
from pathlib import Path
from typing import Any

from workflow.lib.identity import result_identity, sha256
from workflow.lib.load import FormatError, load_provenance
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import FIGURES, REPORT, Panel, Plan, runs_of
from workflow.pipeline.quality import QUALITIES, Quality
from workflow.pipeline.sources import sources_changed
from workflow.pipeline.state import State, differences
from workflow.render.record import read_identity_line, read_record, record_name

HDF5 = b"\x89HDF"  # first bytes of a file


def show(text: str, indent: str = "") -> None:
    """Prints lines of at most 120 columns, except for longer paths."""
    look: dict[str, Any] = {"initial_indent": indent, "subsequent_indent": f"{indent}  "}
    print(textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False, **look))


def show_panel(panel: str, quality: str) -> None:
    target = panel if panel == REPORT else f"panel PANEL={panel}"
    show(f"panel {panel}, quality {quality}: make {target} {Quality.parse(quality).arguments}")


def show_command(provenance: dict[str, Any], indent: str = "") -> None:
    """Command of the program of a result."""
    show(f"{provenance['program']} {provenance['option_words']}", indent)
    if sources_changed(provenance):
        show(f"sources of {provenance['program']} differ here", indent)


def qualities() -> list[str]:
    """Qualities, and those with an effort that have results here."""
    names = [*QUALITIES]
    for folder in Path("data").glob("*_*"):
        with suppress(ConfigurationError):  # a folder of the user
            names.append(Quality.parse(folder.name).name)
    return names


def explain_result(path: Path) -> int:
    """Raises FormatError, also for an edited file."""
    provenance = load_provenance(path)
    program, words = provenance["program"], provenance["option_words"]
    panels = [
        (run.panel, quality)
        for quality in qualities()
        for run in runs_of(Plan(quality)).values()
        if (run.program, run.options_text) == (program, words)
    ]
    state = "current" if panels else "of no panel here"
    if sources_changed(provenance):
        state = f"stale: sources of {program} have changed"
    print(f"unmodified, {state}")
    for panel, quality in panels:
        show_panel(panel, quality)
    show_command(provenance)
    show(f"identity {result_identity(program, words, provenance['source_hash'])}")
    show(f"compiled by {provenance['compiler']} with {provenance['libraries']}")
    return 0


def planned(panel: str, quality: str) -> Panel | None:
    """The present product of this name, if there is one."""
    with suppress(ConfigurationError):  # another quality
        plan = Plan(quality)
        return plan.report if panel == REPORT else plan.panels.get(panel)
    return None


def explain_figure(path: Path) -> int:
    content = path.read_bytes()
    if not (line := read_identity_line(content)):
        print(
            f"{path} has no panel metadata: it is no file of a panel or report, or another program rewrote it"
        )
        return 1
    panel, quality, identity = line
    product = planned(panel, quality)
    if product is None:
        print(f"not checked: there is no panel {panel} of quality {quality} here, identity {identity}")
        return 3
    path = Path(FIGURES, quality, record_name(panel, identity))
    record = read_record(path)
    if not record:
        show(f"{State.NOT_CHECKED}, {State.STALE}: {path} is not here; this makes the present figure:")
        show_panel(panel, quality)
        return 3
    edited = sha256(content) not in record["files"].values()
    stale = f"{State.STALE}: {differences(product, record)}" if product.identity != identity else "current"
    show(f"{State.EDITED if edited else 'unmodified'}, {stale}")
    show_panel(panel, quality)
    show(f"commit {record['commit'] or 'unknown'}, rendered by {record.get('renderer', 'Python')}")
    print(f"made from {len(record['parents'])} files, and the sources in {path}:")
    for parent in [*record["parents"], *product.inputs]:
        print(parent)
        if parent.endswith(".h5"):
            try:
                show_command(load_provenance(parent), "  ")
            except (FormatError, OSError) as error:
                print(error)
    return int(edited)


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

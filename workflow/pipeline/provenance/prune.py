"""Removes the results and figures of a quality that no plan names; DRY=yes lists them.

After a slip in paper.yaml they may be the only results: while planned results of their panels are missing,
FORCE=yes removes them. Exit status: 0, 3 if they stay.

Only files whose names this project gives are removed: RUN.IDENTITY.* in data, and figures of former panels.
Tracked files, the results of the release, stay.
"""

import argparse
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from workflow.lib.files import missing
from workflow.lib.identity import IDENTITY, named_identity, panel_of, read_identity_line
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import FIGURES, REPORT, Panel, data_path, runs_of
from workflow.pipeline.provenance.audit import tracked

GIVEN = re.compile(rf"(.+\.{IDENTITY})\.(h5|log|cost\.json)(\.checkpoint)?(\.\w+\.tmp)?")


def obsolete(quality: str, plan: dict[str, Panel]) -> Iterator[Path]:
    """Files of a quality and effort that its plan does not name. Raises OSError."""
    for file in Path(FIGURES, quality).glob("*.*"):
        panel = file.name.partition(".")[0]
        given_here = named_identity(file) or (read_identity_line(file.read_bytes()) or ())[:2] == (
            panel,
            quality,
        )
        if panel not in (*plan, REPORT) and given_here:
            yield file
    planned = {path.removesuffix(".h5") for path in runs_of(plan, plan, quality)}
    for path in Path("data", quality).glob("*/*"):
        given = GIVEN.fullmatch(str(path))
        if given and given[1] not in planned:
            yield path


def number_missing(quality: str, plan: dict[str, Panel], files: Iterable[Path]) -> int:
    """Number of planned results that do not exist, of the panels of obsolete results; of all panels if one
    of those is not planned, as after a change of its name. Raises OSError."""
    panels = {panel_of(path) for path in files if path.suffix == ".h5"}
    planned = (
        data_path(quality, name, run)
        for name, panel in plan.items()
        for run in panel.runs * (name in panels or not panels <= plan.keys())
    )
    return len(missing(planned))


def main(options: argparse.Namespace) -> int:
    if not options.dry:
        lock_products()
    files = sorted({*obsolete(options.quality, options.plan)} - {*map(Path, tracked())})
    size = sum(path.stat().st_size for path in files) / 1e6
    number = number_missing(options.quality, options.plan, files)
    if number and not options.dry and not options.force:
        print(
            f"{number} planned results are missing, and {len(files)} files are not planned: make report "
            f"{options.effort} first; to remove them now, make prune {options.effort} FORCE=yes"
        )
        return 3
    for path in files:
        print(path)
        if not options.dry:
            path.unlink()
            with suppress(OSError):  # the folder is not empty
                path.parent.rmdir()
    print(f"{'To remove' if options.dry else 'Removed'}: {len(files)} files, {size:.1f} MB")
    return 0

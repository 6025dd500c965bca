"""Removes the results and figures of a selection that its plan does not name; DRY=yes lists them.

After a slip in paper.yaml they may be the only results: while planned results are missing, FORCE=yes removes
them. Only files whose names this project gives are removed: RUN.IDENTITY.* in data, and figures of former
panels. Tracked files, the results of the release, stay. Exit status: 0, 3 if all stay.
"""

import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from workflow.lib.identity import IDENTITY, named_identity
from workflow.pipeline.audit import tracked
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import FIGURES, REPORT, Plan, runs_of
from workflow.render.files import missing
from workflow.render.record import read_identity_line

GIVEN = re.compile(rf"(.+\.{IDENTITY})\.(h5|log|cost\.json)(\.checkpoint)?(\.\w+\.tmp)?")


def obsolete(plan: Plan) -> Iterator[Path]:
    """Files that the plan does not name. Raises OSError."""
    selection = plan.selection.name
    for file in Path(FIGURES, selection).glob("*.*"):
        panel = file.name.partition(".")[0]
        own = (panel, selection) == (read_identity_line(file.read_bytes()) or ())[:2]
        if panel not in (*plan.panels, REPORT) and (own or named_identity(file)):
            yield file
    planned = {path.removesuffix(".h5") for path in runs_of(plan)}
    for path in Path("data", selection).glob("*/*"):
        given = GIVEN.fullmatch(str(path))
        if given and given[1] not in planned:
            yield path


def prune(plan: Plan, *, dry: bool, force: bool) -> int:
    """Returns the exit status. Raises OSError."""
    if not dry:
        lock_products()
    files = sorted({*obsolete(plan)} - {*map(Path, tracked())})
    lacking, options = len(missing(runs_of(plan))), plan.selection.arguments
    if lacking and files and not dry and not force:
        print(
            f"{lacking} planned results are missing, and {len(files)} files are not planned: make report "
            f"{options} first; to remove them now, make prune {options} FORCE=yes"
        )
        return 3
    size = sum(path.stat().st_size for path in files) / 1e6
    for path in files:
        print(path)
        if not dry:
            path.unlink()
            with suppress(OSError):  # the folder is not empty
                path.parent.rmdir()
    print(f"{'To remove' if dry else 'Removed'}: {len(files)} files, {size:.1f} MB")
    return 0

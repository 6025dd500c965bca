"""Removes the results and figures of a quality that no plan names; DRY=yes lists them.

Only files whose names this project gives are removed: NAME.IDENTITY.* in data and in the store, and figures of former panels. Tracked
files, the results of the release, stay.
"""

import argparse
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from workflow.lib.identity import IDENTITY, stated
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import Panel, report_stem, runs_of, stem_of
from workflow.pipeline.provenance.audit import tracked
from workflow.pipeline.publish import FIGURES, RENDERED

GIVEN = re.compile(
    rf"(.+\.{IDENTITY})\.(h5|log|cost\.json|pdf|png|svg|csv|json|html)(\.checkpoint|\.refused)?(\.\w+\.tmp)?"
)


def obsolete(quality: str, plan: dict[str, Panel]) -> Iterator[Path]:
    """Files of a quality and effort that its plan does not name. Raises OSError."""
    planned = {path.removesuffix(".h5") for path in runs_of(plan, plan, quality)}
    planned |= {report_stem(plan, quality), *(stem_of(plan, name, quality) for name in plan)}
    for copy in Path(FIGURES, quality).glob("*.*"):
        if copy.stem not in plan and (stated(copy.read_bytes()) or ())[:2] == (copy.stem, quality):
            yield copy
    for path in [*Path("data", quality).glob("*/*"), *Path(RENDERED, quality).glob("*")]:
        given = GIVEN.fullmatch(str(path))
        if given and (given[1] not in planned or given[3] == ".refused"):
            yield path


def main(options: argparse.Namespace) -> None:
    if not options.dry:
        lock_products()
    files = sorted({*obsolete(options.quality, options.plan)} - {*map(Path, tracked())})
    size = sum(path.stat().st_size for path in files) / 1e6
    for path in files:
        print(path)
        if not options.dry:
            path.unlink()
            with suppress(OSError):  # the folder is not empty
                path.parent.rmdir()
    print(f"{'To remove' if options.dry else 'Removed'}: {len(files)} files, {size:.1f} MB")

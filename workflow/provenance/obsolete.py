"""Removes results and figures that no plan names (`make prune`): those of other options, builds, sources or packages.

The plans are those of all qualities, and those with SEED, REPLICAS, ERROR or HOURS that have a folder in figures.
"""

import re
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

from workflow.lib.configuration import ConfigurationError
from workflow.lib.files import ROOT
from workflow.lib.identity import IDENTITY
from workflow.lib.plan import QUALITIES, Panel, data_path, load_plan
from workflow.provenance.build_id import BuildError
from workflow.provenance.checks import Fault, Kind, Products

OF_A_RESULT = re.compile(r"(.+)\.(?:h5|cost\.json|h5\.checkpoint|h5\.damaged)(?:\.[0-9a-f]{8}\.tmp)?")
OF_A_PANEL = re.compile(rf"([\w-]+)\.(?:pdf|png|svg|csv|html|{IDENTITY}\.json)")


@cache
def plans() -> dict[str, dict[str, Panel]]:
    """Plans by quality. Raises ConfigurationError."""
    found = {name: load_plan(name) for name in QUALITIES}
    for folder in sorted((ROOT / "figures").glob("*_*")):
        with suppress(ConfigurationError):
            found[folder.name] = load_plan(folder.name)
    return found


def obsolete(qualities: Iterable[str] = ()) -> list[Path]:
    """Sorted paths of obsolete files, of these qualities or of all. Raises ConfigurationError, BuildError."""
    folders = {name.partition("_")[0] for name in qualities} or {*QUALITIES}
    known = {
        data_path(quality, panel.name, run).removesuffix(".h5")
        for quality, plan in plans().items()
        for panel in plan.values()
        for run in panel.runs
    }
    found = []
    for file in (file for folder in folders for file in (ROOT / "data" / folder).glob("*/*")):
        parts = OF_A_RESULT.fullmatch(str(file.relative_to(ROOT)))
        if parts and parts[1] not in known:
            found.append(file)
    for quality, plan in plans().items():
        if qualities and quality not in qualities:
            continue
        for file in (ROOT / "figures" / quality).glob("*.*"):
            parts = OF_A_PANEL.fullmatch(file.name)
            if not parts or parts[1] not in {*plan, "report"}:
                found.append(file)
    return sorted(found)


def faults(products: Products, panels: Sequence[str]) -> list[Fault]:
    """Obsolete results and figures of a quality, or of some panels of it; none where they are unknown without a build."""
    try:
        files = obsolete([products.quality])
    except BuildError:
        return []
    files = [file for file in files if file.suffix in (".h5", ".pdf")]
    reason = "no plan names it; make prune removes it"
    return [
        Fault(str(file.relative_to(ROOT)), reason, Kind.OBSOLETE)
        for file in files
        if not panels or {file.parent.name, file.stem} & {*panels}
    ]


def main() -> None:
    try:
        files = obsolete()
    except (ConfigurationError, BuildError) as error:
        sys.exit(str(error))
    size = sum(file.stat().st_size for file in files)
    for file in files:
        file.unlink()
        with suppress(OSError):  # not empty
            file.parent.rmdir()
    results = sum(file.suffix == ".h5" for file in files)
    print(f"Removed {results} results and {len(files) - results} other files, {size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()

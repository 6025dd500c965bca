"""Removes results and figures that no plan names (`make prune`): those of other options, builds, sources or packages.

The plans are those of all qualities, and those with SEED, REPLICAS, ERROR or HOURS that have a folder in figures.
"""

import re
import sys
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path

from workflow.lib.configuration import ConfigurationError
from workflow.lib.files import ROOT
from workflow.lib.identity import IDENTITY
from workflow.lib.plan import QUALITIES, Panel, data_path, load_plan
from workflow.provenance.build_id import BuildError
from workflow.provenance.checks import Fault, Kind, Products

OF_A_RESULT = re.compile(r"(.+)\.(?:h5|cost\.json|h5\.checkpoint|h5\.tmp|h5\.damaged)")
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


def faults(products: Products, panel: str | None) -> list[Fault]:
    """Obsolete results and figures of a quality, or of one panel of it; none where they are unknown without a build."""
    try:
        files = obsolete([products.quality])
    except BuildError:
        return []
    paths = [str(file.relative_to(ROOT)) for file in files if file.suffix in (".h5", ".pdf")]
    return [
        Fault(path, "no plan names it; make prune removes it", Kind.OBSOLETE)
        for path in paths
        if panel is None or panel in (Path(path).parent.name, Path(path).stem)
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

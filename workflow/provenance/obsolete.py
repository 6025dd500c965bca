"""Removes the results and figures of a quality that no plan names (`make prune`): those of other options, builds or sources.

The plans are those of all qualities, and those with SEED, REPLICAS, ERROR or HOURS that have a folder in figures. Only files whose
names the project gives are removed: results with an identity, or with the name of a run alone, as former versions had, and figures
that a record names.
"""

import re
import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

from workflow.cluster.cost import recorded_seconds
from workflow.lib.command import command
from workflow.lib.configuration import ConfigurationError
from workflow.lib.figure_metadata import MetadataError, read_panel
from workflow.lib.files import ROOT
from workflow.lib.identity import IDENTITY
from workflow.lib.plan import QUALITIES, Panel, Quality, data_path, load_plan
from workflow.provenance.build_id import BuildError
from workflow.provenance.checks import Fault, Kind, Products

OF_A_RESULT = re.compile(
    rf"((.+?)(\.{IDENTITY})?)\.(?:h5|cost\.json|h5\.checkpoint|h5\.damaged)(?:(?:\.[0-9a-f]{{8}})?\.tmp)?"
)
OF_A_PANEL = re.compile(rf"(.+)\.{IDENTITY}\.json")
REPORT = "report"  # has a record like a panel


@cache
def plans() -> dict[str, dict[str, Panel]]:
    """Plans by quality. Raises ConfigurationError."""
    by_quality = {name: load_plan(name) for name in QUALITIES}
    for folder in sorted((ROOT / "figures").glob("*_*")):
        with suppress(ConfigurationError):
            by_quality[folder.name] = load_plan(folder.name)
    return by_quality


def obsolete(quality: str, panels: Sequence[str] = ()) -> list[Path]:
    """Sorted paths of obsolete files of a quality, of these panels or of all. Raises ConfigurationError, BuildError."""
    planned = {
        data_path(name, panel.name, run).removesuffix(".h5")
        for name, plan in plans().items()
        for panel in plan.values()
        for run in panel.runs
    }
    runs = {stem.rpartition(".")[0] for stem in planned}
    obsolete_files = set()
    for file in (ROOT / "data" / quality.partition("_")[0]).glob("*/*"):
        parts = OF_A_RESULT.fullmatch(str(file.relative_to(ROOT)))
        if not parts or parts[1] in planned or (panels and file.parent.name not in panels):
            continue
        if parts[3] or parts[2] in runs:
            obsolete_files.add(file)
    stems = {*plans().get(quality, ()), REPORT}  # a quality without a folder of figures is not in plans()
    for record in (ROOT / "figures" / quality).glob("*.json"):
        parts = OF_A_PANEL.fullmatch(record.name)
        if not parts or parts[1] in stems or (panels and parts[1] not in panels):
            continue
        with suppress(MetadataError, OSError):
            files = [record.with_name(name) for name in read_panel(record)["files"]]
            obsolete_files |= {
                record,
                *(file for file in files if file.parent == record.parent and file.is_file()),
            }
    return sorted(obsolete_files)


def faults(products: Products, panels: Sequence[str]) -> list[Fault]:
    """Obsolete results and figures of a quality, or of some panels of it; none where they are unknown without a build."""
    try:
        files = [str(file.relative_to(ROOT)) for file in obsolete(products.quality, panels)]
    except BuildError:
        return []
    reason = f"no plan names it; make prune {Quality.of(products.quality).arguments} removes it"
    return [Fault(file, reason, Kind.OBSOLETE) for file in files if file.endswith((".h5", ".pdf"))]


def main() -> None:
    options, _, _ = command(__doc__, dry={"action": "store_true", "help": "only list the files"})
    try:
        files = obsolete(options.quality, options.panel or [])
    except (ConfigurationError, BuildError) as error:
        sys.exit(str(error))
    results = [file for file in files if file.suffix == ".h5"]
    seconds = sum(recorded_seconds(str(file.relative_to(ROOT))) or 0 for file in results)
    size = sum(file.stat().st_size for file in files)
    for file in files:
        print(file.relative_to(ROOT))
        if not options.dry:
            file.unlink()
            with suppress(OSError):  # raised if the folder is not empty
                file.parent.rmdir()
    done = "To remove" if options.dry else "Removed"
    others = len(files) - len(results)
    print(
        f"{done}: {len(results)} results ({seconds:.0f} CPU s) and {others} other files, {size / 1e6:.1f} MB"
    )


if __name__ == "__main__":
    main()

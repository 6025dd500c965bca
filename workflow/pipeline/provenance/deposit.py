"""Packs the tracked files, results and figures of a quality as build/deposit/lorentz-gas-QUALITY.zip, with SHA256SUMS.

Its metadata are those of CITATION.cff. Unpacked elsewhere, `make figures` finds results and figures under the names that it
gives them, which depend neither on the folder nor on the compiler.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from workflow.lib.identity import ROOT, sha256
from workflow.pipeline.described import DESCRIPTIONS
from workflow.pipeline.plan import report_stem, runs_of, stem_of
from workflow.pipeline.provenance.audit import check
from workflow.pipeline.publish import copies


def git(*words: str) -> list[str]:
    """Lines of git on the repository of this folder, not of one around it. Exits if git fails."""
    command = ["git", "--git-dir=.git", "--work-tree=.", "-c", "core.quotePath=off", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"Only tracked files are packed, and git fails: {done.stderr.strip()}")
    return done.stdout.splitlines()


def pack(archive: Path, paths: Iterable[str]) -> None:
    """Writes files into an archive, whole or not at all. Raises OSError."""
    hashes, temporary = "", archive.with_suffix(".tmp")
    temporary.parent.mkdir(parents=True, exist_ok=True)
    with ZipFile(temporary, "w", ZIP_DEFLATED) as packed:
        for path in sorted(paths):
            content = Path(path).read_bytes()
            hashes += f"{sha256(content)}  {path}\n"
            entry = ZipInfo(f"{archive.stem}/{path}")  # its default time is constant
            entry.external_attr = (0o755 if os.access(path, os.X_OK) else 0o644) << 16
            packed.writestr(entry, content, ZIP_DEFLATED)
        packed.writestr(ZipInfo(f"{archive.stem}/SHA256SUMS"), hashes)
    temporary.replace(archive)


def main(options: argparse.Namespace) -> None:
    """Exits if a product does not hold or a source is not tracked."""
    quality, plan = options.quality, options.plan
    if new := git("ls-files", "--others", "--exclude-standard", "cpp", "workflow"):
        sys.exit(f"{new[0]} is not tracked, and would be missing in the deposit: git add it, or move it away")
    if faults := check(plan, [*plan], quality, render=False):
        first = faults[0]
        remedy = f"; run make report {options.effort}" if first.state in ("missing", "stale") else ""
        sys.exit(f"{first.path} is {first.state}: {first.reason}{remedy}")
    results = runs_of(plan, plan, quality)
    costs = [cost for path in results if os.path.exists(cost := path.replace(".h5", ".cost.json"))]
    paths = {*git("ls-files"), *results, *costs, *(path for panel in plan.values() for path in panel.reads)}
    # For status and load_panel before make build.
    paths |= {*map(str, DESCRIPTIONS.relative_to(ROOT).glob("*.json"))}
    for stem in map(Path, [*(stem_of(plan, name, quality) for name in plan), report_stem(plan, quality)]):
        paths |= {*map(str, [*stem.parent.glob(f"{stem.name}.*"), *copies(stem)])}
    archive = Path(f"build/deposit/lorentz-gas-{quality}.zip")
    pack(archive, paths)
    print(f"The deposit is {archive}")

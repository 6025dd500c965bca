"""Packs code, configuration, data, figures and the runs that made them into a Workflow Run RO-Crate.

Equal inputs give equal bytes. Run by make: python -m workflow.provenance.crate --quality QUALITY.
"""

import argparse
import shutil
import sys
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from rocrate.rocrate import ROCrate

from workflow.lib.plan import Panel, Quality, load_plan, panel_named, with_used
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance import report_links
from workflow.provenance.chain import Chain
from workflow.provenance.crate_graph import crate_of
from workflow.provenance.job import Job
from workflow.provenance.lock import Lock, LockError, builds_of
from workflow.provenance.repository import ROOT, git

PLACE = ROOT / "build/crate"
DRAFT = "smoke"
NAMED = 5  # stale jobs that a refusal names
# What belongs to the project where git cannot tell.
FOLDERS = ("cpp", "docs", "profiles", "tests", "workflow")
FILES = (
    "Makefile",
    "Snakefile",
    "requirements.lock",
    "requirements-build.lock",
    "requirements-dev.lock",
    ".clang-format",
    ".clang-tidy",
    ".ruff.toml",
)
PAPERS = (
    "README.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "codecheck.yml",
    "codemeta.json",
    "LICENSE",
    "LICENSES/MIT.txt",
    "REUSE.toml",
    ".gitignore",
    "data/README.md",
    "data/claims.csv",
    "figures/README.md",
)


class CrateError(ValueError):
    """There is nothing that can be packed; the message says why and what to do."""


def chosen_jobs(lock: Lock, plan: dict[str, Panel], panel: str | None, remedy: str) -> dict[str, Job]:
    """Jobs of the panel, or of all, runs before the drawing that shows them. Raises CrateError if one is stale."""
    panels = [panel] if panel else list(plan)
    stale = Chain(lock.quality, plan, lock).stale(panels)
    if stale:
        named = [f"\n  {job}: {reason}" for job, reason in list(stale.items())[:NAMED]]
        more = f"\n  and {len(stale) - NAMED} more" if len(stale) > NAMED else ""
        hint = "" if panel else "; with PANEL=fig05 one panel is packed alone"
        raise CrateError(
            f"products are missing or stale:{''.join(named)}{more}\nMake them with {remedy}{hint}"
        )
    runs = [f"{one.name}/{run.name}" for name in panels for one in with_used(plan, name) for run in one.runs]
    return {name: lock.jobs[name] for name in dict.fromkeys([*runs, *panels])}


def written_report(chain: Chain) -> list[str]:
    """Paths of the report, none if there is none. Raises CrateError if it does not follow from the products."""
    for link in report_links.report(chain):
        raise CrateError(f"{link.path} {link.message}")
    return [path for path in report_links.paths(chain.quality) if chain.hashes[path]]


def source_files(lock: Lock, jobs: dict[str, Job]) -> set[str]:
    """The project's files, and what the jobs were made from, tracked by git or not; relative paths."""
    scripts = [path for job in jobs.values() for path in job.sources]
    builds = builds_of(jobs.values())
    built = [f"cpp/{path}" for build_id in builds for path in lock.builds[build_id]["sources"]]
    return {*project_files(), *scripts, *built}


def project_files() -> list[str]:
    if (ROOT / ".git").exists() and (listed := git("ls-files", "-z")):
        return [path for path in listed.decode().split("\0") if (ROOT / path).is_file()]
    below = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*") if path.is_file()]
    sources = [str(path.relative_to(ROOT)) for path in below if "__pycache__" not in path.parts]
    return [*FILES, *PAPERS, *sources]


def write(crate: ROCrate, folder: Path, archive: Path) -> None:
    """Writes both beside their places and renames them, so that neither is ever there by half."""
    unfinished, zipped = (path.with_name(f"{path.name}.tmp") for path in (folder, archive))
    shutil.rmtree(unfinished, ignore_errors=True)
    crate.write(unfinished)
    with ZipFile(zipped, "w") as content:
        for path in sorted(path for path in unfinished.rglob("*") if path.is_file()):
            entry = ZipInfo(str(path.relative_to(unfinished)))  # its time is the same for every file
            entry.external_attr = 0o644 << 16
            content.writestr(entry, path.read_bytes(), ZIP_DEFLATED)
    shutil.rmtree(folder, ignore_errors=True)
    unfinished.replace(folder)
    zipped.replace(archive)


def pack(quality: str, panel: str | None) -> Path:
    """The archive. Raises CrateError, LockError or ConfigurationError."""
    plan = load_plan(quality)
    if Quality.of(quality).base == DRAFT:
        raise CrateError(
            f"QUALITY={DRAFT} makes drafts, which are not packed: choose standard, paper or deep"
        )
    if panel:
        panel_named(plan, panel)
    remedy = f"make {f'panel PANEL={panel}' if panel else 'figures'} QUALITY={quality}"
    try:
        lock = Lock.read(quality)
    except LockError as error:
        raise CrateError(f"{error}, so nobody knows what made the products: {remedy} writes it") from error
    jobs = chosen_jobs(lock, plan, panel, remedy)
    report = [] if panel else written_report(Chain(quality, plan, lock))
    archive = PLACE / f"lorentz-gas-{quality}.zip"
    write(crate_of(lock, jobs, source_files(lock, jobs), report, remedy), PLACE / quality, archive)
    return archive


def main() -> None:
    parser = argparse.ArgumentParser(description="Packs products and their history into an RO-Crate")
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="this panel only, with the runs that it uses")
    options = parser.parse_args()
    try:
        archive = pack(options.quality, options.panel)
    except (CrateError, ConfigurationError) as error:
        print(f"make crate: {error}", file=sys.stderr)
        sys.exit(2)
    print(f"The crate is {archive.relative_to(ROOT)}, unpacked in build/crate/{options.quality}")


if __name__ == "__main__":
    main()

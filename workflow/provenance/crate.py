"""Packs code, configuration, data, figures and their runs into a Workflow Run RO-Crate.

Equal inputs give equal bytes: the crate has no time of day, host, user or folder.
"""

import shlex
import shutil
import sys
from collections.abc import Iterable
from datetime import date
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from rocrate.model import ContextEntity, Entity
from rocrate.rocrate import ROCrate

from workflow.lib.citation import citation
from workflow.lib.closure import PACKAGES
from workflow.lib.command import command
from workflow.lib.configuration import arguments
from workflow.lib.figure_metadata import read_panel
from workflow.lib.files import ROOT, file_hash, project_files
from workflow.lib.plan import with_used
from workflow.provenance.checks import Products

RUN = "https://w3id.org/ro/wfrun"
PROFILES = {
    f"{RUN}/process/0.5": "Process Run Crate",
    f"{RUN}/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
TYPES = {".csv": "text/csv", ".h5": "application/x-hdf5", ".json": "application/json", ".md": "text/markdown"}
TYPES |= {".pdf": "application/pdf", ".png": "image/png", ".svg": "image/svg+xml", ".html": "text/html"}


def new_crate(quality: str) -> ROCrate:
    """Crate without files, with the metadata of CITATION.cff and LICENSE."""
    crate, cited, licence = ROCrate(version="1.1"), citation(ROOT), (ROOT / "LICENSE").read_text()
    crate.metadata.extra_terms |= {"sha256": "https://w3id.org/ro/terms/workflow-run#sha256"}
    crate.name = cited["title"]
    crate.description = f"Code, configuration, data, figures and their runs at quality {quality}"
    crate.datePublished = date.fromisoformat(str(cited["date-released"]))
    text = {"@type": "CreativeWork", "name": licence.partition("\n")[0], "description": licence}
    crate.license = add(crate, f"https://spdx.org/licenses/{cited['license']}", text)
    root = crate.root_dataset
    root["version"] = cited["version"]
    names = [
        author.get("name") or f"{author['given-names']} {author['family-names']}"
        for author in cited["authors"]
    ]
    kinds = ["Person" if "family-names" in author else "Organization" for author in cited["authors"]]
    authors = enumerate(zip(kinds, names, strict=True), 1)
    root["author"] = compact(
        [add(crate, f"#author-{i}", {"@type": kind, "name": name}) for i, (kind, name) in authors]
    )
    root["conformsTo"] = [
        add(crate, url, {"@type": "CreativeWork", "name": name, "version": url.rpartition("/")[2]})
        for url, name in PROFILES.items()
    ]
    return crate


def pack(products: Products, panels: list[str]) -> ROCrate:
    """Crate of the panels, the results that they plot, and all sources."""
    quality, plan, crate = products.quality, products.plan, new_crate(products.quality)
    shown = {used.name: used for name in panels for used in with_used(plan, name)}
    scripts = {name: f"workflow/figures/{plan[name].script}.py" for name in panels}
    data = {path for name in panels for path in products.results_of(name)}
    drawn = {name: products.files_of(plan[name]) for name in panels}
    figures = {path for paths in drawn.values() for path in paths}
    parents = {name: read_panel(ROOT / products.record(plan[name]))["parents"].inputs() for name in panels}
    read = {path for paths in parents.values() for path in paths}  # may include files that git ignores
    files = {
        path: add_file(crate, path, path in scripts.values())
        for path in sorted({*project_files(), *data, *figures, *read})
    }
    files["README.md"]["about"] = crate.root_dataset

    def action(
        name: str, tool: Entity, command: str, inputs: Iterable[str], outputs: Iterable[str]
    ) -> Entity:
        properties = {"@type": "CreateAction", "name": name, "instrument": tool, "description": command}
        properties["object"] = [files[path] for path in inputs]
        properties["result"] = compact([files[path] for path in outputs])
        return add(crate, f"#{name}", properties)

    settings = ["workflow/config/paper.yaml", f"workflow/config/quality/{quality.partition('_')[0]}.yaml"]
    command = f"make figures QUALITY={quality}"
    inputs = [*settings, PACKAGES]
    actions = [action("workflow", files["Snakefile"], command, inputs, sorted({*data, *figures}))]
    for panel in shown.values():
        for run in panel.runs:
            properties = {"@type": "SoftwareApplication", "name": run.program}
            properties["isBasedOn"] = files[f"cpp/observables/{run.program}.cpp"]
            tool = crate.get(f"#program/{run.program}") or add(crate, f"#program/{run.program}", properties)
            command = shlex.join([run.program, *arguments(run.options)])
            output = products.result(panel.name, run)
            actions.append(action(f"job/{panel.name}/{run.name}", tool, command, settings, [output]))
    for name, script in scripts.items():
        actions.append(action(f"job/{name}", files[script], f"Renders {name}", parents[name], drawn[name]))
    crate.root_dataset["mentions"] = actions
    return crate


def add(crate: ROCrate, identifier: str, properties: dict[str, Any]) -> Entity:
    return crate.add(ContextEntity(crate, identifier, properties))


def add_file(crate: ROCrate, path: str, is_script: bool) -> Entity:
    properties: dict[str, Any] = {"name": path, "sha256": file_hash(ROOT / path)}
    properties["encodingFormat"] = TYPES.get(Path(path).suffix, "text/plain")
    if path == "Snakefile" or is_script:
        properties["version"] = crate.root_dataset["version"]
    if path == "Snakefile":
        described = {"properties": properties, "main": True, "lang": "snakemake", "record_size": True}
        return crate.add_workflow(ROOT / path, path, **described)
    if is_script:
        properties |= {"@type": ["File", "SoftwareSourceCode"], "programmingLanguage": "Python"}
    return crate.add_file(ROOT / path, path, properties=properties, record_size=True)


def compact(values: list[Entity]) -> Entity | list[Entity]:
    """A single value instead of a list of one, as RO-Crate requires."""
    return values[0] if len(values) == 1 else values


def write(crate: ROCrate, folder: Path, archive: Path) -> None:
    """Writes the folder and a zip archive of it, both atomically."""
    unfinished = folder.with_name(f"{folder.name}.tmp")
    shutil.rmtree(unfinished, ignore_errors=True)
    crate.write(unfinished)
    with ZipFile(archive.with_suffix(".tmp"), "w") as content:
        for path in sorted(path for path in unfinished.rglob("*") if path.is_file()):
            entry = ZipInfo(str(path.relative_to(unfinished)))  # its default time is constant
            entry.external_attr = 0o644 << 16
            content.writestr(entry, path.read_bytes(), ZIP_DEFLATED)
    shutil.rmtree(folder, ignore_errors=True)
    unfinished.replace(folder)
    archive.with_suffix(".tmp").replace(archive)


def main() -> None:
    options, plan, _ = command(__doc__, archive={"type": Path, "required": True, "help": "zip file to write"})
    products = Products(options.quality, plan)
    names = options.panel or [*plan]
    for fault in (fault for name in names for fault in products.faults(name)):
        sys.exit(
            f"{fault.path}: {fault.reason}{'' if 'run make' in fault.reason else f'; run make figures QUALITY={options.quality}'}"
        )
    folder = ROOT / "build/crate" / options.quality
    write(pack(products, names), folder, ROOT / options.archive)
    print(f"The crate is {options.archive}, unpacked in {folder.relative_to(ROOT)}")


if __name__ == "__main__":
    main()

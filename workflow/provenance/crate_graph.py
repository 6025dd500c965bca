"""Which job made which product from what: one CreateAction for every job, one for the workflow as a whole.

It is taken from the lock alone, so that nothing names a time of day, a host, a user or a folder of this machine.
"""

import os
import shlex
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, date, datetime
from typing import Any

from rocrate.model import Entity
from rocrate.rocrate import ROCrate

from workflow.lib.options import arguments
from workflow.lib.parents import PACKAGES
from workflow.provenance.bill_of_materials import NAME as BILL
from workflow.provenance.bill_of_materials import bill_of_materials
from workflow.provenance.crate_files import WORKFLOW, add, add_files, add_text, compact, new_crate
from workflow.provenance.job import Job
from workflow.provenance.lock import Lock, builds_of, configuration_files
from workflow.provenance.repository import ROOT, git

REPORT_SCRIPT, CLAIMS = "workflow/report/write.py", "data/claims.csv"


@dataclass(frozen=True)
class Action:
    """What was done by which tool; inputs and outputs are paths."""

    identifier: str
    name: str
    tool: Entity
    command: str
    inputs: Iterable[str]
    outputs: Iterable[str]


def crate_of(
    lock: Lock, jobs: dict[str, Job], sources: set[str], report: list[str], remade_by: str
) -> ROCrate:
    """The crate of some jobs of the lock, of all sources, and of the report if it has paths; `remade_by` is the command
    that makes the same products again."""
    description = (
        f"Code, configuration, data and figures at quality {lock.quality}, and the runs that made them"
    )
    crate = new_crate(description, published(jobs))
    products = {path for job in jobs.values() for path in job.outputs}
    scripts = {REPORT_SCRIPT, *(job.tool for job in jobs.values() if job.is_drawing)}
    lock_path = str(Lock.path(lock.quality).relative_to(ROOT))
    files = add_files(crate, {*sources, *products, *report, lock_path}, scripts)
    used = sorted(builds_of(jobs.values()))
    libraries = [lock.builds[build_id]["libraries"] for build_id in used]
    add_text(crate, BILL, bill_of_materials(f"lorentz-gas-{lock.quality}", published(jobs), libraries))
    programs = {build_id: _add_program(crate, lock.builds[build_id], files) for build_id in used}

    settings = configuration_files(lock.quality)
    inputs = [*settings, PACKAGES]
    actions = [Action("#workflow", remade_by, files[WORKFLOW], remade_by, inputs, sorted(products))]
    for name, job in jobs.items():
        if job.is_drawing:
            actions.append(_drawing(name, job, files[job.tool]))
        else:
            actions.append(_run(name, job, programs[job.build], settings))
    if report:
        judged = [*sorted(products), CLAIMS, PACKAGES]
        actions.append(Action("#report", "report", files[REPORT_SCRIPT], "Judges the claims", judged, report))
    crate.root_dataset["mentions"] = [_add_action(crate, action, files) for action in actions]
    return crate


def published(jobs: dict[str, Job]) -> date:
    """Day of the newest commit that made one of the products; of SOURCE_DATE_EPOCH where no commit is known."""
    commits = {job.commit for job in jobs.values() if job.commit}
    shown = [git("show", "--no-patch", "--format=%ct", commit) for commit in commits]
    stamps = [int(stamp) for stamp in shown if stamp]
    return datetime.fromtimestamp(max(stamps, default=int(os.environ["SOURCE_DATE_EPOCH"])), UTC).date()


def _drawing(name: str, job: Job, script: Entity) -> Action:
    return Action(f"#job/{name}", name, script, f"Draws {name}", job.inputs, job.outputs)


def _run(name: str, job: Job, program: Entity, settings: list[str]) -> Action:
    command = shlex.join([job.tool, *arguments(job.options)])
    return Action(f"#job/{name}", name, program, command, settings, job.outputs)


def _add_program(crate: ROCrate, build: dict[str, Any], files: dict[str, Entity]) -> Entity:
    """The executable is not packed, what it was built from is."""
    properties = {
        "@type": "SoftwareApplication",
        "name": build["program"],
        "version": build["build_id"],
        "description": f"{build['compiler']}; {build['flags']}; {build['libraries']}",
        "isBasedOn": [files[f"cpp/{path}"] for path in build["sources"]],
    }
    return add(crate, f"#program/{build['program']}", properties)


def _add_action(crate: ROCrate, action: Action, files: dict[str, Entity]) -> Entity:
    properties = {
        "@type": "CreateAction",
        "name": action.name,
        "instrument": action.tool,
        "description": action.command,
        "object": [files[path] for path in action.inputs],
        "result": compact([files[path] for path in action.outputs]),
    }
    return add(crate, action.identifier, properties)

"""What the entries of a lock may hold, so that whoever reads one need not doubt it again. Standard library only."""

import re
from typing import Any

from workflow.provenance.build_id import IDENTITY

SHA256, COMMIT = re.compile(r"[0-9a-f]{64}"), re.compile(r"[0-9a-f]{40}|[0-9a-f]{64}")
PATH = re.compile(r"[^\0\ud800-\udfff]+")


def require(holds: bool, what: str) -> None:
    """Raises TypeError."""
    if not holds:
        raise TypeError(what)


def matches(pattern: re.Pattern[str], value: Any) -> bool:
    return isinstance(value, str) and pattern.fullmatch(value) is not None


def are_hashes(value: Any) -> bool:
    return isinstance(value, dict) and all(
        matches(PATH, path) and matches(SHA256, digest) for path, digest in value.items()
    )


def check_job(name: str, job: Any, configuration: list[str]) -> None:
    """Raises TypeError. configuration: the files that asked for it."""
    is_run = job.build_id is not None
    parts = name.split("/")
    require(len(parts) <= 2 and not {"", ".", ".."} & {*parts}, f"name {name!r}")  # it is part of paths
    require(isinstance(job.tool, str) and isinstance(job.machine, str), f"tool or machine of {name}")
    require(isinstance(job.options, dict), f"options of {name}")
    require(is_run or matches(SHA256, job.options.get("configuration")), f"configuration of {name}")
    for part in ("outputs", "configuration", "pipeline", "inputs"):
        require(are_hashes(getattr(job, part)), f"{part} of {name}")
    require(job.configuration.keys() == {*configuration}, f"configuration of {name}")
    require("Makefile" in job.pipeline and "Snakefile" in job.pipeline, f"pipeline of {name}")
    require(type(job.exit) is int and job.exit in (0, 4), f"exit of {name}")
    outside = job.commit is None and job.dirty is None
    require(outside or (matches(COMMIT, job.commit) and isinstance(job.dirty, bool)), f"commit of {name}")
    if is_run:
        require(matches(SHA256, job.build_id) and matches(SHA256, job.executable), f"program of {name}")
        require(job.inputs == {} and job.python is None, f"inputs of {name}")
    else:
        require(job.executable is None and isinstance(job.python, str), f"python of {name}")


def check_build(identifier: str, build: Any) -> None:
    """Raises TypeError."""
    require(matches(SHA256, identifier) and isinstance(build, dict), f"build {identifier}")
    require(all(isinstance(build.get(part), str) for part in IDENTITY), f"build {identifier}")
    require(build.keys() == {*IDENTITY, "build_id", "sources"}, f"entries of build {identifier}")
    require(build["build_id"] == identifier, f"name of build {identifier}")
    require(are_hashes(build.get("sources")), f"sources of build {identifier}")

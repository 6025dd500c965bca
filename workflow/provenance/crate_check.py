"""What is here against a deposited crate of `make crate`, which nobody who changes this folder can change."""

import hashlib
import json
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workflow.provenance.bill_of_materials import NAME as BILL
from workflow.provenance.chain import Chain
from workflow.provenance.links import Link, unchecked

METADATA = "ro-crate-metadata.json"
# Of a job in the lock; commit, machine and executable may be others where the same is made again.
COMPARED = ("tool", "options", "exit", "build_id", "inputs", "outputs")


class CrateError(ValueError):
    """It is no crate of this project."""


@dataclass(frozen=True)
class Deposit:
    """Hashes by path as the crate states them, those of its own files, and the lock that it holds."""

    stated: dict[str, str]
    held: dict[str, str]
    quality: str
    jobs: dict[str, dict[str, Any]]

    @classmethod
    def read(cls, path: Path) -> "Deposit":
        """Raises CrateError."""
        try:
            contents = _zipped(path) if path.is_file() else _unpacked(path)
            graph = json.loads(contents[METADATA])["@graph"]
            stated = {entity["@id"]: entity["sha256"] for entity in graph if "sha256" in entity}
            (lock_path,) = (
                name for name in stated if name.startswith("data/") and name.endswith("/lock.json")
            )
            lock = json.loads(contents[lock_path])
            made = {entity["name"] for entity in graph if entity["@type"] == "CreateAction"}
            jobs = {
                name: {key: job[key] for key in COMPARED}
                for name, job in lock["jobs"].items()
                if name in made
            }
            del stated[lock_path]  # it names all jobs of the quality, packed or not
            if not jobs:
                raise ValueError("no job of its lock is an action of its metadata")
            held = {name: hashlib.sha256(content).hexdigest() for name, content in contents.items()}
            return cls(stated, held, lock["quality"], jobs)
        except OSError as error:
            raise CrateError(f"CRATE={path} cannot be read: {error.strerror}") from error
        except Exception as error:  # a damaged or forged crate may raise anything in what reads it
            raise CrateError(
                f"CRATE={path} is no crate of this project: give a folder or zip that `make crate` wrote"
            ) from error

    @property
    def extent(self) -> str:
        return f"{len(self.stated)} files and {len(self.jobs)} jobs of the crate"

    def differences(self, chain: Chain, names: set[str]) -> Iterator[Link]:
        """Of files and of the lock's entries; names: of the jobs that are looked at. Raises CrateError if the crate is of another quality."""
        if self.quality != chain.quality:
            raise CrateError(f"the crate is of quality {self.quality}: give QUALITY={self.quality}")
        made = chain.lock.outputs()
        for path, digest in self.stated.items():
            if self.held.get(path) != digest:
                yield Link(path, "is damaged or missing in the crate itself")
            elif path == BILL:
                continue  # the crate alone has it
            elif chain.hashes[path] is None:
                yield Link(path, "is in the crate and not here")
            elif chain.hashes[path] != digest:
                yield Link(path, "is not what the crate holds")
            elif path in made and made[path] != digest:
                yield Link(path, "is what the crate holds, and the lock says otherwise")
        if missing := (names & chain.lock.jobs.keys()) - self.jobs.keys():
            text = f"the crate has {len(missing)} of {len(names)} jobs not, such as {min(missing)}: they are not compared"
            yield unchecked(f"CRATE of quality {self.quality}", text)
        for name, job in self.jobs.items():
            here = chain.lock.jobs.get(name)
            differing = [key for key in job if not here or getattr(here, key) != job[key]]
            if differing:
                yield Link(
                    f"data/{chain.quality}/lock.json",
                    f"names other {differing[0]} of {name} than the crate",
                )


def _zipped(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}


def _unpacked(path: Path) -> dict[str, bytes]:
    """Regular files only."""
    files = [file for file in path.rglob("*") if file.is_file()]
    if not files:
        raise FileNotFoundError(2, "there is no such file, or the folder is empty")
    return {str(file.relative_to(path)): file.read_bytes() for file in files}

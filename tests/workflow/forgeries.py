"""What may be tampered with, each with how an audit names it."""

import hashlib
import os
import socket
import subprocess
from pathlib import Path

import h5py

from tests.workflow.conftest import Clone, append, copy, delete, replace
from tests.workflow.tampering import (
    EMPTY,
    LOCK,
    PICTURE,
    PROGRAM,
    UNKNOWN,
    both,
    in_place_of,
    other_machine,
    paint_red,
    relock,
    state_executable,
)

DATA = "data/smoke/fig03/paper.h5"
TABLE = "figures/smoke/fig03.csv"
MORE = "data/smoke/fig03/more.h5"  # which no job makes


def bind(path: Path) -> None:
    """A socket; its name is short, as the length of such an address is limited."""
    before = Path.cwd()
    os.chdir(path.parent)
    try:
        socket.socket(socket.AF_UNIX).bind(path.name)
    finally:
        os.chdir(before)


def other_executable(content: dict) -> None:
    content["jobs"]["fig03/equal"]["executable"] = "0" * 64


def other_shape(content: dict) -> None:
    content["jobs"]["fig03"]["inputs"] = []


def no_commit(content: dict) -> None:
    for job in content["jobs"].values():
        job |= {"commit": None, "dirty": None}


def uncommitted(content: dict) -> None:
    content["jobs"]["fig03"]["dirty"] = True


def untracked(content: dict) -> None:
    content["jobs"]["fig03"]["pipeline"]["build/system-packages"] = hashlib.sha256(b"").hexdigest()


def flip_bit(clone: Clone) -> None:
    content = bytearray((clone.folder / DATA).read_bytes())
    content[-5] ^= 1
    (clone.folder / DATA).write_bytes(content)


def forge_attribute(clone: Clone) -> None:
    with h5py.File(clone.folder / DATA, "r+") as file:
        file["provenance"].attrs["source_hash"] = "0" * 64


def forge_value(clone: Clone) -> None:
    with h5py.File(clone.folder / DATA, "r+") as file:
        file["results/energy_current/mean"][()] *= 1.001


def other_commit(content: dict) -> None:
    content["jobs"]["fig03"]["commit"] = "0" * 40


def other_flags(content: dict) -> None:
    for build in content["builds"].values():
        build["flags"] = "-Ofast"


def other_quality(content: dict) -> None:
    content["quality"] = "paper"


def link_to_what_was_there(path: Path) -> None:
    text = subprocess.check_output(["git", "show", f"HEAD:./{path.name}"], cwd=path.parent)
    (path.parent / "copy").write_bytes(text)
    path.symlink_to("copy")


TAMPERINGS = {
    "bit flipped": (flip_bit, DATA),
    "table edited": (replace(TABLE, ",", ", "), TABLE),
    "table edited, lock too": (both(replace(TABLE, "0.", "1."), relock()), TABLE),
    "picture edited": (append("figures/smoke/fig03.png", "x"), "figures/smoke/fig03.png"),
    "figure of another panel": (
        copy("figures/smoke/fig05.pdf", "figures/smoke/fig03.pdf"),
        "figures/smoke/fig03.pdf",
    ),
    "figure of another panel, lock too": (
        both(copy("figures/smoke/fig05.svg", "figures/smoke/fig03.svg"), relock()),
        "figures/smoke/fig03.svg",
    ),
    "data of another run": (copy("data/smoke/fig03/equal.h5", DATA), DATA),
    "data of another run, lock too": (both(copy("data/smoke/fig03/equal.h5", DATA), relock()), DATA),
    "attribute forged": (forge_attribute, DATA),
    "attribute forged, lock too": (both(forge_attribute, relock()), DATA),
    "value forged, lock too": (both(forge_value, relock()), "figures/smoke/fig03.pdf"),
    "parameter": (
        replace("workflow/config/paper.yaml", "decades: 6", "decades: 5"),
        "workflow/config/paper.yaml",
    ),
    "effort": (
        replace("workflow/config/quality/smoke.yaml", "{replicas: 4}", "{replicas: 5}"),
        "workflow/config/quality/smoke.yaml",
    ),
    "configuration deleted": (
        delete("workflow/config/quality/smoke.yaml"),
        "workflow/config/quality/smoke.yaml",
    ),
    "configuration spoilt": (append("workflow/config/paper.yaml", "}\n"), "workflow/config/paper.yaml"),
    "script": (append("workflow/figures/fig03.py", "# x\n"), "workflow/figures/fig03.py"),
    "shared module deleted": (delete("workflow/lib/fit.py"), "workflow/lib/fit.py"),
    "C++ source": (append("cpp/numerics/gmres.cpp", "// x\n"), "cpp/numerics/gmres.cpp"),
    "C++ source deleted": (delete("cpp/numerics/gmres.cpp"), "cpp/numerics/gmres.cpp"),
    "Python packages": (append("requirements.lock", "# x\n"), "requirements.lock"),
    "data deleted": (delete(DATA), DATA),
    "figure deleted": (delete("figures/smoke/fig03.svg"), "figures/smoke/fig03.svg"),
    "data without parents": (copy(DATA, "data/smoke/fig03/more.h5"), "data/smoke/fig03/more.h5"),
    "figure without parents": (copy(TABLE, "figures/smoke/fig99.csv"), "figures/smoke/fig99.csv"),
    "lock edited": (replace(LOCK, "GNU", "gnu"), LOCK),
    "lock deleted": (delete(LOCK), LOCK),
    "lock of another quality": (relock(other_quality), LOCK),
    "commit forged": (relock(other_commit), "commit 000000000000"),
    "flags forged": (relock(other_flags), "build "),
    "lock of another shape": (relock(other_shape), LOCK),
    "script spoilt": (append("workflow/figures/fig03.py", "def (\n"), "workflow/figures/fig03.py"),
    "program edited": (append(PROGRAM, "x"), PROGRAM),
    "program edited, its hash too": (both(append(PROGRAM, "x"), state_executable), PROGRAM),
    "program of another build": (
        replace("build/id/boltzmann.json", '"build_id": "', '"build_id": "0'),
        PROGRAM,
    ),
    "record of the build spoilt": (append("build/id/boltzmann.json", "}"), PROGRAM),
    "flags of the program forged": (replace("build/id/boltzmann.json", "-O3", "-O2"), PROGRAM),
    "two programs of one build": (relock(other_executable), PROGRAM),
    "queue among the data": (in_place_of(MORE, os.mkfifo), MORE),
    "socket among the data": (in_place_of("data/smoke/x", bind), "data/smoke/x"),
    "link among the data": (in_place_of(MORE, lambda path: path.symlink_to("paper.h5")), MORE),
    "link to nowhere": (in_place_of(MORE, lambda path: path.symlink_to("nowhere")), MORE),
    "link to a folder": (
        in_place_of("figures/smoke/more", lambda path: path.symlink_to("..")),
        "figures/smoke/more",
    ),
    "empty folder among the data": (in_place_of(EMPTY[0], Path.mkdir), EMPTY[0]),
    "empty folder among the figures": (in_place_of(EMPTY[1], Path.mkdir), EMPTY[1]),
    "empty folder of no quality": (in_place_of(UNKNOWN[0], Path.mkdir), UNKNOWN[0]),
    "figure of no quality": (
        both(in_place_of(UNKNOWN[1], Path.mkdir), copy(PICTURE, f"{UNKNOWN[1]}/fig03.png")),
        UNKNOWN[1],
    ),
    "queue in place of data": (in_place_of(DATA, os.mkfifo), DATA),
    "queue in place of a picture": (in_place_of(PICTURE, os.mkfifo), PICTURE),
    "link in place of a script": (
        in_place_of("workflow/figures/fig03.py", link_to_what_was_there),
        "workflow/figures/fig03.py",
    ),
    "queue in place of a script": (
        in_place_of("workflow/figures/fig03.py", os.mkfifo),
        "workflow/figures/fig03.py",
    ),
    "folder in place of a module": (in_place_of("workflow/lib/fit.py", Path.mkdir), "workflow/lib/fit.py"),
    "queue in place of C++": (in_place_of("cpp/numerics/gmres.cpp", os.mkfifo), "cpp/numerics/gmres.cpp"),
    "queue in place of the configuration": (
        in_place_of("workflow/config/paper.yaml", os.mkfifo),
        "workflow/config/paper.yaml",
    ),
    "red picture, as if drawn elsewhere": (both(paint_red, relock(other_machine)), PICTURE),
}

# Of those that are not done beside others: they forge the lock, or an audit ends with them.
APART = ("lock", "forged", "configuration", "two programs", "as if drawn elsewhere", "commit", "uncommitted")

UNCHECKED = {
    "Makefile changed": (append("Makefile", "# x\n"), "Makefile (has changed since"),
    "programs not built": (delete(PROGRAM), f"{PROGRAM} (is not built here)"),
    "no commit": (relock(no_commit), "sources against their commits ("),
    "uncommitted changes": (
        relock(uncommitted),
        "sources against their commits (1 jobs were done with uncommitted changes)",
    ),
    "a header in the place of a library's": (
        in_place_of("cpp/sleef.h", Path.touch),
        "cpp/sleef.h (untracked: no commit has it, and it may take the place of a file that one has)",
    ),
    "a source that no job names": (
        append("workflow/lib/layout.py", "# x\n"),
        "workflow/lib/layout.py (is not what the commit that is checked out holds)",
    ),
    "other bands of the verdicts": (
        replace("data/claims.csv", "-0.1 to 0.1", "-9 to 9"),
        "data/claims.csv (is not what the commit that is checked out holds)",
    ),
    "a file of no commit": (relock(untracked), "build/system-packages (is not in commit "),
}

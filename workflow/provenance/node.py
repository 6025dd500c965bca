"""Whether a program finds the same shared libraries on a node of a cluster as where the run was started.

Standard library only, as it is asked by every job.
"""

import subprocess
from collections.abc import Iterable
from pathlib import Path

from workflow.lib.places import regular
from workflow.provenance.repository import ROOT, write_whole

NOTES = Path("build/libraries")  # a file per program, written where the run is started
PLAIN = {"PATH": "/usr/bin:/bin", "LC_ALL": "C"}


def linked(program: str) -> list[str]:
    """Names of the files of the shared libraries that the program takes on this machine; they end with versions. Empty where
    the loader does not tell."""
    command = ["ldd", str(ROOT / "build/bin" / program)]
    try:
        told = subprocess.run(command, env=PLAIN, capture_output=True, text=True, check=False).stdout
    except FileNotFoundError:
        return []
    return sorted(Path(line.split()[2]).resolve().name for line in told.splitlines() if " => /" in line)


def note_libraries(programs: Iterable[str]) -> None:
    """Raises OSError."""
    (ROOT / NOTES).mkdir(exist_ok=True)
    for program in programs:
        write_whole(ROOT / NOTES / program, "\n".join(linked(program)))


def difference_of_node(program: str) -> str | None:
    """What is other here, where results might differ therefore."""
    here, there = linked(program), regular(ROOT / NOTES / program).read_text().splitlines()
    if here == there:
        return None
    other, one = (", ".join(sorted({*a} - {*b})) or "nothing" for a, b in ((here, there), (there, here)))
    return (
        f"This node has {other} where the one that started the run has {one}: use nodes with equal libraries"
    )

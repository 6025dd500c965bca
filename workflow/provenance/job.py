"""What a lock says of one job."""

from dataclasses import dataclass, field

from workflow.lib.options import Options


@dataclass(frozen=True)
class Job:
    """A run of a program, `panel/run`, or the drawing of a panel, `panel`. Paths are relative to the project, hashes
    are sha256."""

    tool: str  # program, or script
    options: Options  # of the program; of a drawing, the hash of the panel's configuration
    outputs: dict[str, str]  # path: hash
    configuration: dict[str, str]  # path: hash of the files that asked for it
    commit: str | None  # of the repository when the job was done
    dirty: bool | None  # whether tracked files differed from it
    machine: str
    exit: int
    pipeline: dict[str, str]  # path: hash of the files that ran it
    build_id: str | None = None  # of the program
    executable: str | None = None  # hash of the program's file
    inputs: dict[str, str] = field(
        default_factory=dict
    )  # of a drawing: path: hash of sources, packages, data
    python: str | None = None  # version that drew

    @property
    def is_drawing(self) -> bool:
        return self.build_id is None

    @property
    def build(self) -> str:
        """Build id of the program; empty for a drawing, which no build has."""
        return self.build_id or ""

    @property
    def sources(self) -> dict[str, str]:
        """Of a drawing: script, modules that it imports, locked packages."""
        return {path: digest for path, digest in self.inputs.items() if path not in self.data}

    @property
    def data(self) -> dict[str, str]:
        return {path: digest for path, digest in self.inputs.items() if path.startswith("data/")}

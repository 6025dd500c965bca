"""A panel to be rendered, from the plan to workflow.lib.render."""

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Job:
    """A panel to be rendered. stem: FOLDER/QUALITY/PANEL; data: paths of the results; reads: other files
    that the script reads; identity: the planned one, "" if none is."""

    script: str
    stem: str
    data: list[str]
    reads: list[str] = field(default_factory=list)
    identity: str = ""

    @property
    def panel(self) -> str:
        return Path(self.stem).name

    @property
    def json(self) -> str:
        return json.dumps(asdict(self))

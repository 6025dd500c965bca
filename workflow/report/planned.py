"""Results of a quality, loaded by the plan for the claims."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from workflow.claims.data import Data, MissingError
from workflow.lib.load import Result, load
from workflow.pipeline.plan import Run, data_path, load_plan


class Planned(Data):
    """The results at one quality. Each file is loaded once, when a claim first needs it."""

    def __init__(self, quality: str, root: Path) -> None:
        super().__init__()
        self.quality, self.root = quality, root
        self.plan = load_plan(quality)
        self.loaded: dict[str, Result] = {}  # by path

    def candidates(self, panel: str, series: Sequence[str], wanted: Mapping[str, object]) -> list[Result]:
        return [
            self._load(panel, run)
            for run in self._runs(panel)
            if run.series in series
            and all(run.options.get(name.replace("_", "-"), value) == value for name, value in wanted.items())
        ]

    def one(self, panel: str, run: str) -> Result:
        for planned in self._runs(panel):
            if planned.name == run:
                return self._load(panel, planned)
        raise MissingError(f"{panel} has no run {run} at quality {self.quality}")

    def _runs(self, panel: str) -> tuple[Run, ...]:
        return self.plan[panel].runs if panel in self.plan else ()

    def _load(self, panel: str, run: Run) -> Result:
        path = data_path(self.quality, panel, run)
        if not (self.root / path).exists():
            raise MissingError(f"{path} is missing")
        if path not in self.loaded:
            self.loaded[path] = load(self.root / path)
        return self.loaded[path]

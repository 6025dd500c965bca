"""The plan of a selection: panels with their runs, the report, and the paths of all that is made."""

import itertools
import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from workflow.lib.identity import ROOT, result_identity, run_name
from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import (
    EFFORT_OPTIONS,
    PANELS,
    SCRIPTS,
    STUDY,
    ConfigurationError,
    Document,
    Options,
    arguments,
    load_configuration,
    merge_efforts,
    programs_of,
    require_distinct,
)
from workflow.pipeline.polynomial import evaluated
from workflow.pipeline.selection import DEFAULT_QUALITY, Selection
from workflow.pipeline.sources import is_sampled, source_hash
from workflow.render.files import missing
from workflow.render.record import (
    FORMATS,
    NUMBERS,
    panel_identity,
    read_record,
    record_name,
    sources_of_panel,
    states_release,
)

FIGURES = "figures"
FIGURE_SCRIPTS = "workflow/figures"
REPORT = "report"
RESULT = "{panel}/{run}.{identity}.h5"  # below data/SELECTION
PYTHON = ".venv/bin/python"


@dataclass(frozen=True)
class Run:
    """One execution of a program. The name is unique within its panel, folder is data/QUALITY/PANEL."""

    name: str
    series: str  # key in the configuration; the name also has the listed values
    program: str
    options: Options
    folder: str

    @property
    def panel(self) -> str:
        return Path(self.folder).name

    @property
    def options_text(self) -> str:
        """Options as on the command line, as the program states them in its result."""
        return " ".join(arguments(self.options))

    @cached_property
    def path(self) -> str:
        """Path of the result, with a hash of all that determines it. Raises OSError."""
        identity = result_identity(self.program, self.options_text, source_hash(self.program))
        return f"{self.folder}/{self.name}.{identity}.h5"


@dataclass(frozen=True)
class Panel:
    """Files in figures/QUALITY with their record: a figure, or the report, whose parents are the figures.

    runs: its own; plotted: those of the panels that it uses, then its own; inputs: other files and folders
    that its script uses; replaced: options of paper.yaml that the quality replaces, as `cells of rare`; study:
    it is of the study and made for the report only."""

    name: str
    selection: str
    script: str
    runs: tuple[Run, ...] = ()
    plotted: tuple[Run, ...] = ()
    figures: tuple["Panel", ...] = ()
    inputs: tuple[str, ...] = ()
    replaced: tuple[str, ...] = ()
    study: bool = False

    def run(self, name: str) -> Run:
        """Its own run of this name."""
        return next(run for run in self.runs if run.name == name)

    @property
    def stem(self) -> str:
        """Path of the files, without suffix."""
        return f"{FIGURES}/{self.selection}/{self.name}"

    @property
    def parents(self) -> list[str]:
        """Paths of the plotted results, or of the files of all figures. Raises OSError."""
        return [run.path for run in self.plotted] + [path for panel in self.figures for path in panel.files]

    @property
    def sources(self) -> dict[str, str]:
        """Hashes of what determines the files besides the parents. Raises ConfigurationError, OSError."""
        try:
            return sources_of_panel(self.script, self.inputs)
        except FileNotFoundError as error:
            text = f"panel {self.name} has no script: write {error.filename}"
            raise ConfigurationError(text) from error

    @cached_property
    def identity(self) -> str:
        return panel_identity(self.name, self.parents, self.sources)

    @property
    def record_path(self) -> str:
        return f"{FIGURES}/{self.selection}/{record_name(self.name, self.identity)}"

    @property
    def files(self) -> list[str]:
        """Paths of all files, the record last."""
        formats = ("html",) if self.figures else FORMATS
        return [*(f"{self.stem}.{suffix}" for suffix in formats), self.record_path]

    @property
    def record(self) -> dict[str, Any]:
        """Empty if the files are not made."""
        return read_record(self.record_path)

    def is_incomplete(self) -> bool:
        """Whether a file of the panel, or one that it is made from, is missing. Raises ConfigurationError,
        OSError."""
        return bool(missing([*self.parents, *self.files]))

    @property
    def log(self) -> str:
        """Path of what its command prints."""
        return f"build/logs/{self.selection}/{self.name}.log"

    def command(self, stem: str = "") -> list[str]:
        """Command that renders the panel, with another stem elsewhere; or the report."""
        if self.figures:
            return [PYTHON, "-m", "workflow.study.report", self.selection]
        job = {"script": self.script, "stem": stem or self.stem, "results": self.parents}
        return [
            PYTHON,
            "-m",
            "workflow.render",
            json.dumps(job | {"inputs": self.inputs, "planned": self.identity}),
        ]


class Plan:
    """What is made at a selection. Raises ConfigurationError."""

    def __init__(self, selection: str = DEFAULT_QUALITY, files: Sequence[Path] = PANELS) -> None:
        """selection: a name as Selection parses it; files: YAML files with panels, the paper's first."""
        self.selection = Selection.parse(selection)
        read = [
            load_configuration(self.selection.quality, file, files[0])
            for file in files
            if file.exists() or file == files[0]
        ]
        require_distinct([document for document, _ in read])
        default = read[0][1].content["default"]
        found: dict[str, Panel] = {}
        uses: dict[str, Sequence[str]] = {}
        for document, efforts in read:
            for name, panel in document.content["panels"].items():
                found[name] = self._panel(name, panel, efforts.content, default, document.file)
                uses[name] = panel.get("uses", ())
        for document, _ in read:
            self._check(document, found)
        self.panels = {
            name: replace(panel, plotted=tuple(run for one in (*uses[name], name) for run in found[one].runs))
            for name, panel in found.items()
        }

    def __getitem__(self, name: str) -> Panel:
        """The panel of this name. Raises ConfigurationError."""
        require_panel(name, self.panels)
        return self.panels[name]

    def __iter__(self) -> Iterator[Panel]:
        return iter(self.panels.values())

    @property
    def paper(self) -> list[Panel]:
        """Panels of `make figures`: the paper's, `accuracy` and `stability`."""
        return [panel for panel in self if not panel.study]

    @cached_property
    def report(self) -> Panel | None:
        """None without the study."""
        if not STUDY.parent.exists():
            return None
        inputs = ["workflow/study", "workflow/pipeline", *[NUMBERS] * states_release(self.selection.name)]
        script = "workflow/study/report.py"
        return Panel(REPORT, self.selection.name, script, figures=tuple(self), inputs=tuple(inputs))

    def _panel(
        self, name: str, panel: dict[str, Any], efforts: dict[str, Any], default: Options, file: Path
    ) -> Panel:
        own = efforts.get("panels", {}).get(name, {})
        runs: list[Run] = []
        replaced: list[str] = []
        of_panel = {key: value for key, value in own.items() if key in EFFORT_OPTIONS}
        for series, program in programs_of(panel).items():
            if series in own.get("omit", ()):
                continue
            physics = panel.get("common", {}) | panel["series"][series]
            general = (default, of_panel) if is_sampled(program) else ()
            effort = merge_efforts({}, *general, own.get(series, {}))
            replaced += [f"{key} of {series}" for key in effort if key in physics]
            runs += self._runs(name, series, program, physics | effort)
        paths = [
            f"{folder}/{panel.get('script', name)}.py"
            for folder in (SCRIPTS.get(file), FIGURE_SCRIPTS)
            if folder
        ]
        script = next((path for path in paths if (ROOT / path).exists()), paths[0])
        inputs = tuple(
            path for path in panel.get("inputs", ()) if path != NUMBERS or states_release(self.selection.name)
        )
        return Panel(
            name, self.selection.name, script, tuple(runs), (), (), inputs, tuple(replaced), file == STUDY
        )

    def _runs(self, panel: str, series: str, program: str, options: Options) -> Iterator[Run]:
        """The runs of a series: one for each combination of the values of options with a list."""
        scale = options.pop("target-scale", None)
        options.pop("program", None)
        listed = [key for key, value in options.items() if isinstance(value, list)]
        for values in itertools.product(*(options[key] for key in listed)):
            chosen = dict(zip(listed, values, strict=True))
            name, one = run_name(series, chosen), options | chosen
            one = {key: evaluated(value, one.get("cells")) for key, value in one.items()}
            if is_sampled(program):
                one = self.selection.with_effort(f"{panel}/{name}", one, scale)
            yield Run(name, series, program, one, f"data/{self.selection.name}/{panel}")

    def _check(self, document: Document, planned: dict[str, Panel]) -> None:
        """Raises ConfigurationError for a panel without runs, or with runs or inputs that do not exist."""
        for name, panel in document.content["panels"].items():
            place = ("panels", name)
            if "series" in panel and not planned[name].runs and "uses" not in panel:
                text = f"no runs at quality {self.selection.name}, and no panel whose runs it uses"
                raise ConfigurationError(document.complaint(place, text))
            for number, used in enumerate(panel.get("uses", ())):
                if used not in planned or not planned[used].runs:
                    text = f"{used} has no runs; {suggestion(used, {*planned} - {name, used})}"
                    raise ConfigurationError(document.complaint((*place, "uses", number), text))
            for number, path in enumerate(panel.get("inputs", ())):
                inside = not Path(path).is_absolute() and ".." not in Path(path).parts
                if path != NUMBERS and not (inside and (ROOT / path).exists()):
                    text = f"{path} is not a file or folder below {ROOT}, or not its path from there"
                    raise ConfigurationError(
                        document.complaint((*place, "inputs", number), f"{text}: write it there")
                    )


def require_panel(name: str, known: Iterable[str]) -> None:
    """Raises ConfigurationError with the most similar of the known names."""
    if name not in known:
        raise ConfigurationError(f"{name} is not a panel; {suggestion(name, known)}")


def runs_of(panels: Iterable[Panel]) -> dict[str, Run]:
    """Runs that these panels plot, by the paths of their results. Raises OSError."""
    return {run.path: run for panel in panels for run in panel.plotted}


def doubtful(panels: Iterable[Panel]) -> dict[str, list[str]]:
    """Reasons to doubt a result, by its path, of the results that panels with a present record plot.
    Raises ConfigurationError, OSError."""
    return {path: why for panel in panels for path, why in panel.record.get("doubts", {}).items()}

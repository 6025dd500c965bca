"""The plan of a quality: panels with their runs, the report, and the paths of all that is made."""

import itertools
import json
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

from workflow.lib.identity import ROOT, result_identity, run_name
from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import (
    PANELS,
    SCRIPTS,
    STUDY,
    ConfigurationError,
    Document,
    Keys,
    Options,
    arguments,
    load_configuration,
    merge_efforts,
    programs_of,
    require_distinct,
)
from workflow.pipeline.quality import DEFAULT_QUALITY, Quality
from workflow.pipeline.sources import is_sampled, source_hash
from workflow.render.files import missing
from workflow.render.record import (
    FORMATS,
    panel_identity,
    read_record,
    record_name,
    sources_of_panel,
)

FIGURES = "figures"
FIGURE_SCRIPTS = "workflow/figures"
REPORT = "report"
RESULT = "{panel}/{run}.{identity}.h5"  # below data/QUALITY
PYTHON = ".venv/bin/python"


@dataclass(frozen=True)
class Run:
    """One execution of a program. The name is unique within its panel, folder is data/QUALITY/PANEL."""

    name: str
    series: str  # key in the configuration; the name also has the listed values
    program: str
    options: Options
    folder: str
    # Files and keys that give its options, by their names; "": of the series.
    where: dict[str, tuple[Document, Keys]] = field(default_factory=dict, compare=False)

    def position(self, options: Iterable[str]) -> str:
        """File, line and keys of the first of these options that is given, else of the series."""
        document, keys = self.where[next((option for option in options if option in self.where), "")]
        return document.position(keys)

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
    """A figure: files in figures/QUALITY, with a record of what they are made from. inputs: other files and
    folders that the script uses; runs: its own; plotted: those of the panels that it uses, then its own;
    replaced: options of paper.yaml that the quality replaces, as `cells of rare`; file: of its block."""

    name: str
    quality: str
    script: str
    inputs: tuple[str, ...] = ()
    runs: tuple[Run, ...] = ()
    plotted: tuple[Run, ...] = ()
    replaced: tuple[str, ...] = ()
    file: Path = PANELS[0]

    formats: ClassVar[Sequence[str]] = FORMATS

    def run(self, name: str) -> Run:
        """Its own run of this name."""
        return next(run for run in self.runs if run.name == name)

    @property
    def study(self) -> bool:
        """Whether it is of the study, made for the report only."""
        return self.file == STUDY

    @property
    def parents(self) -> list[str]:
        """Paths of the results that it is made from. Raises OSError."""
        return [run.path for run in self.plotted]

    @property
    def stem(self) -> str:
        """Path of the files, without suffix."""
        return f"{FIGURES}/{self.quality}/{self.name}"

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
        return f"{FIGURES}/{self.quality}/{record_name(self.name, self.identity)}"

    @property
    def files(self) -> list[str]:
        """Paths of all files, the record last."""
        return [*(f"{self.stem}.{suffix}" for suffix in self.formats), self.record_path]

    @property
    def record(self) -> dict[str, Any]:
        """Empty if the files are not made."""
        return read_record(self.record_path)

    def is_incomplete(self) -> bool:
        """Whether one of its files, or of those that it is made from, is missing. Raises ConfigurationError,
        OSError."""
        return bool(missing([*self.parents, *self.files]))

    @property
    def log(self) -> str:
        """Path of what its command prints."""
        return f"build/logs/{self.quality}/{self.name}.log"

    @property
    def job_path(self) -> str:
        """Path of the job for the command."""
        return f"build/jobs/{self.quality}/{self.name}.json"

    def job(self, stem: str = "") -> str:
        """What workflow.render reads: the arguments of render(). stem: of the files, if they are written
        elsewhere."""
        return json.dumps(
            {
                "script": self.script,
                "stem": stem or self.stem,
                "results": self.parents,
                "inputs": self.inputs,
                "planned": self.identity,
            }
        )

    @property
    def command(self) -> str:
        """Command line that makes it."""
        return f"{PYTHON} -m workflow.render < '{self.job_path}'"


@dataclass(frozen=True)
class Report(Panel):
    """The report, made from the files of panels."""

    panels: tuple[Panel, ...] = ()

    formats: ClassVar[Sequence[str]] = ("html",)

    @property
    def parents(self) -> list[str]:
        return [path for panel in self.panels for path in panel.files]

    @property
    def command(self) -> str:
        return f"{PYTHON} -m workflow.study.report '{self.quality}'"


class Plan:
    """What is made at a quality. Raises ConfigurationError."""

    def __init__(self, quality: str = DEFAULT_QUALITY, files: Sequence[Path] = PANELS) -> None:
        """quality: a name as Quality parses it; files: YAML files with panels, the paper's first."""
        self.quality = Quality.parse(quality)
        read = [
            load_configuration(self.quality.file, file, files[0])
            for file in files
            if file.exists() or file == files[0]
        ]
        require_distinct([document for document, _ in read])
        planned: dict[str, Panel] = {}
        uses: dict[str, Sequence[str]] = {}
        for document, efforts in read:
            for name, panel in document.content["panels"].items():
                planned[name] = self._panel(name, panel, document, efforts, read[0][1])
                uses[name] = panel.get("uses", ())
        for document, _ in read:
            self._check(document, planned)
        self.panels = {
            name: replace(
                panel, plotted=tuple(run for one in (*uses[name], name) for run in planned[one].runs)
            )
            for name, panel in planned.items()
        }

    def __getitem__(self, name: str) -> Panel:
        """The panel of this name. Raises ConfigurationError."""
        if name not in self.panels:
            raise ConfigurationError(f"{name} is not a panel; {suggestion(name, self.panels)}")
        return self.panels[name]

    def __iter__(self) -> Iterator[Panel]:
        return iter(self.panels.values())

    @property
    def paper(self) -> list[Panel]:
        """Panels of `make figures`: the paper's, `accuracy` and `stability`."""
        return [panel for panel in self if panel.file == PANELS[0]]

    @cached_property
    def report(self) -> Report | None:
        """None without the study. Panels of the user are not in it."""
        if not STUDY.parent.exists():
            return None
        inputs = ("workflow/study", "workflow/pipeline")
        script = "workflow/study/report.py"
        return Report(REPORT, self.quality.name, script, inputs, panels=tuple(self.reported))

    @property
    def reported(self) -> list[Panel]:
        """Panels of the report: those of the paper and of the study."""
        return [panel for panel in self if panel.file in (PANELS[0], STUDY)]

    def _panel(
        self, name: str, panel: dict[str, Any], document: Document, efforts: Document, general: Document
    ) -> Panel:
        """general: the file with the default effort."""
        own, at = efforts.content.get("panels", {}).get(name, {}), ("panels", name)
        runs: list[Run] = []
        replaced: list[str] = []
        of_panel = {key: value for key, value in own.items() if key != "omit" and not isinstance(value, dict)}
        for series, program in programs_of(panel).items():
            if series in own.get("omit", ()):
                continue
            given: list[tuple[Document, Keys, Options]] = [
                (document, (*at, "common"), panel.get("common", {})),
                (document, (*at, "series", series), panel["series"][series]),
            ]
            physics = given[0][-1] | given[1][-1]
            if is_sampled(program):
                given += [(general, ("default",), general.content["default"]), (efforts, at, of_panel)]
            given.append((efforts, (*at, series), own.get(series, {})))
            effort = merge_efforts({}, *(options for *_, options in given[2:]))
            replaced += [f"{key} of {series}" for key in effort if key in physics]
            where: dict[str, tuple[Document, Keys]] = {"": (document, (*at, "series", series))}
            where |= {key: (file, (*keys, key)) for file, keys, options in given for key in options}
            runs += self._runs(name, series, program, physics | effort, where)
        folders = [folder for folder in (SCRIPTS.get(document.file), FIGURE_SCRIPTS) if folder]
        paths = [f"{folder}/{panel.get('script', name)}.py" for folder in folders]
        script = next((path for path in paths if (ROOT / path).exists()), paths[0])
        return Panel(
            name,
            self.quality.name,
            script,
            tuple(panel.get("inputs", ())),
            runs=tuple(runs),
            replaced=tuple(replaced),
            file=document.file,
        )

    def _runs(
        self,
        panel: str,
        series: str,
        program: str,
        options: Options,
        where: dict[str, tuple[Document, Keys]],
    ) -> Iterator[Run]:
        """The runs of a series: one for each combination of the values of options with a list."""
        options.pop("program", None)
        listed = [key for key, value in options.items() if isinstance(value, list)]
        for values in itertools.product(*(options[key] for key in listed)):
            chosen = dict(zip(listed, values, strict=True))
            name, one = run_name(series, chosen), options | chosen
            one = {key: in_numbers(value, one.get("cells")) for key, value in one.items()}
            if is_sampled(program):
                one = self.quality.with_effort(f"{panel}/{name}", one)
            yield Run(name, series, program, one, f"data/{self.quality.name}/{panel}", where)

    def _check(self, document: Document, planned: dict[str, Panel]) -> None:
        """Raises ConfigurationError for a panel without runs, or with runs or inputs that do not exist."""
        for name, panel in document.content["panels"].items():
            keys = ("panels", name)
            if not planned[name].runs and "uses" not in panel:
                text = f"no runs at quality {self.quality.name}, and no panel whose runs it uses"
                raise ConfigurationError(document.complaint(keys, text))
            with_runs = [other for other, one in planned.items() if one.runs and other != name]
            for number, used in enumerate(panel.get("uses", ())):
                document.require(used, with_runs, (*keys, "uses", number), "panel with runs")
            for number, path in enumerate(panel.get("inputs", ())):
                inside = not Path(path).is_absolute() and ".." not in Path(path).parts
                if not (inside and (ROOT / path).exists()):
                    text = f"{path} is not a file or folder below {ROOT}, or not its path from there"
                    raise ConfigurationError(
                        document.complaint((*keys, "inputs", number), f"{text}: write it there")
                    )


def in_numbers(value: object, cells: object) -> object:
    """A multiple of the number of cells, as 0.05N, as a number; other values of options as they are."""
    multiple = re.fullmatch(r"([0-9]+\.?[0-9]*|\.[0-9]+)N", str(value))
    return float(f"{float(multiple[1]) * cells:.12g}") if multiple and isinstance(cells, int) else value


def runs_of(panels: Iterable[Panel]) -> dict[str, Run]:
    """Runs that these panels plot, by the paths of their results. Raises OSError."""
    return {run.path: run for panel in panels for run in panel.plotted}


def warnings_of(panels: Iterable[Panel]) -> dict[str, list[str]]:
    """Warnings of the results that panels with a present record plot, by path. Raises ConfigurationError,
    OSError."""
    return {path: why for panel in panels for path, why in panel.record.get("warnings", {}).items()}

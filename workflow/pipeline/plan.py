"""Plan of the configuration: the panels, their runs, and the names of their products."""

import hashlib
import itertools
import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from workflow.lib.identity import (
    NUMBERS,
    ROOT,
    SHARED,
    content_hash,
    identity,
    panel_identity,
    record_name,
    result_identity,
    sources_of_panel,
    states_release,
)
from workflow.lib.job import Job
from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import (
    CONFIGURATION,
    EFFORT_OPTIONS,
    ConfigurationError,
    Options,
    arguments,
    load_configuration,
    programs_of,
    require_short,
)
from workflow.pipeline.polynomial import NUMBER, evaluated
from workflow.pipeline.sources import is_sampled, source_hash

RESULT = "data/{quality}/{panel}/{run}.{identity}.h5"
FIGURES = "figures"
KINDS = ("pdf", "png", "svg", "csv")  # files of a panel
REPORT = "report"  # a product with a record, as a panel
QUALITIES = ("smoke", "standard", "paper")
DEFAULT_QUALITY = "standard"
REPORT_SOURCES = (
    "workflow/claims",
    "workflow/report",
    "workflow/pipeline",
    "data/claims.csv",
    *SHARED,
)
OVERRIDES: dict[str, tuple[str, Any, str]] = {  # pattern, type and description of the allowed values
    "seed": ("0|[1-9][0-9]{0,17}", int, "a whole number from 0 to 10^18 - 1"),
    "replicas": ("[1-9][0-9]{0,17}", int, "a whole number, at least 1"),
    "error": (NUMBER, float, "a number greater than 0 and less than 1, as 0.02 for 2 %"),
}


@dataclass(frozen=True)
class Run:
    """One execution of a program, with a name that is unique within its panel."""

    name: str
    program: str
    options: Options
    series: str = ""  # key in the configuration; the name also has the listed values

    @property
    def replicated(self) -> bool:
        """Whether the program has random numbers, hence a seed and replicas."""
        return "seed" in self.options

    @property
    def options_text(self) -> str:
        """Options as on the command line, as the program states them in its result."""
        return " ".join(arguments(self.options))

    @cached_property
    def identity(self) -> str:
        """Hash of all that determines the result. Raises OSError."""
        return result_identity(self.program, self.options_text, source_hash(self.program))


@dataclass(frozen=True)
class Panel:
    """A figure: its own runs, and the names of other panels whose runs it also plots. replaced: options of
    paper.yaml that the quality replaces, as `cells of rare`; reads: files and folders that the script uses;
    beyond: not of the paper, and made for the report only."""

    name: str
    script: str
    runs: tuple[Run, ...]
    uses: tuple[str, ...] = ()
    replaced: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()
    beyond: bool = False

    def run(self, name: str) -> Run:
        return next(run for run in self.runs if run.name == name)


@dataclass(frozen=True)
class Selection:
    """A quality with the effort of the command line, by the name of its folders of data and figures:
    `standard`, or `standard_seed=7_replicas=200`."""

    name: str
    quality: str
    seed: int | None = None
    replicas: int | None = None
    error: float | None = None  # relative standard error of the target quantity of every run

    @classmethod
    def parse(cls, name: str) -> "Selection":
        """Parses the name of the folder. Raises ConfigurationError."""
        base, *given = name.split("_")
        if base not in QUALITIES:
            raise ConfigurationError(f"{base} is not a quality; choose one of {', '.join(QUALITIES)}")
        values: dict[str, Any] = {}
        for key, _, text in (word.partition("=") for word in given):
            if key not in OVERRIDES:
                raise ConfigurationError(f"{key}={text} is no effort; {suggestion(key, OVERRIDES)}")
            if key in values:
                raise ConfigurationError(f"{key}={text} is given more than once; give it once")
            pattern, number, allowed = OVERRIDES[key]
            if not re.fullmatch(pattern, text) or (number is float and not 0 < float(text) < 1):
                raise ConfigurationError(f"{key.upper()}={text} is invalid; give {allowed}")
            require_short(text)
            values[key] = number(text)
        if "error" in values and "replicas" in values:
            raise ConfigurationError(
                "ERROR and REPLICAS both determine the number of replicas; give one of them"
            )
        return cls(name, base, **values)

    @property
    def arguments(self) -> str:
        """Arguments of make that select this quality and effort."""
        given = {"QUALITY": self.quality, **{key.upper(): getattr(self, key) for key in OVERRIDES}}
        return " ".join(f"{name}={value}" for name, value in given.items() if value is not None)

    def with_effort(self, names: str, options: Options, scale: float | None) -> Options:
        """Options of a replicated run with its effort as options of the program, and its seed. names: of
        panel and run, or of the panel alone, from which the seed follows; scale: reference value of the
        error where the target may be 0."""
        given = {key: value for key in ("replicas", "error") if (value := getattr(self, key)) is not None}
        own = _merged(options, given)
        if "error" in own:
            own["target-error"] = own.pop("error")
            own |= {} if scale is None else {"target-scale": scale}
        return own | {"seed": seed_of(names if self.seed is None else f"{names}/{self.seed}")}


def seed_of(text: str) -> int:
    """Seed from a hash of names, which gives every run its own reproducible random streams."""
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big")


@cache
def load_plan(name: str, folder: Path = CONFIGURATION) -> dict[str, Panel]:
    """All panels of a quality, by name. Raises ConfigurationError."""
    selection = Selection.parse(name)
    paper, efforts = load_configuration(selection.quality, folder)
    effort = efforts.content
    panels = {name: _panel(name, panel, effort, selection) for name, panel in paper.content["panels"].items()}
    for panel in panels.values():
        if "series" in paper.content["panels"][panel.name] and not panel.runs and not panel.uses:
            text = f"no runs at quality {name}, and no panel whose runs it uses"
            raise ConfigurationError(paper.complaint(("panels", panel.name), text))
        for number, used in enumerate(panel.uses):
            if used not in panels or not panels[used].runs:
                text = f"{used} has no runs; {suggestion(used, {*panels} - {panel.name, used})}"
                raise ConfigurationError(paper.complaint(("panels", panel.name, "uses", number), text))
        for number, path in enumerate(panel.reads):
            inside = not Path(path).is_absolute() and ".." not in Path(path).parts
            if not inside or not (ROOT / path).exists():
                text = (
                    f"{path} is not a file or folder below {ROOT}, or not its path from there: write it there"
                )
                raise ConfigurationError(paper.complaint(("panels", panel.name, "reads", number), text))
    return panels


def require_panel(name: str, known: Collection[str]) -> None:
    """Raises ConfigurationError with the most similar of the known names."""
    if name not in known:
        raise ConfigurationError(f"{name} is not a panel; {suggestion(name, known)}")


def default_panels(plan: dict[str, Panel]) -> list[str]:
    """Panels of `make figures`: the paper's, `accuracy` and `stability`."""
    return [name for name, panel in plan.items() if not panel.beyond]


def panel_named(plan: dict[str, Panel], name: str) -> Panel:
    """The panel of this name. Raises ConfigurationError."""
    require_panel(name, plan)
    return plan[name]


def with_used(plan: dict[str, Panel], name: str) -> list[Panel]:
    """Panels with plotted runs: `uses`, then the panel itself."""
    return [plan[used] for used in (*plan[name].uses, name)]


def data_path(quality: str, panel: str, run: Run) -> str:
    """Path of a result. Raises OSError."""
    return RESULT.format(quality=quality, panel=panel, run=run.name, identity=run.identity)


def runs_of(plan: dict[str, Panel], names: Iterable[str], quality: str) -> dict[str, Run]:
    """Runs that these panels plot, by the paths of their results. Raises OSError."""
    panels = (panel for name in names for panel in with_used(plan, name))
    return {data_path(quality, panel.name, run): run for panel in panels for run in panel.runs}


def data_of(plan: dict[str, Panel], name: str, quality: str) -> list[str]:
    """Paths of the results that a panel plots. Raises OSError."""
    return [*runs_of(plan, [name], quality)]


def identity_of(plan: dict[str, Panel], name: str, quality: str) -> str:
    """Identity of a panel or of the report. Raises ConfigurationError, OSError."""
    if name == REPORT:
        paths = [path for path in REPORT_SOURCES if (ROOT / path).exists()]
        paths += [NUMBERS] * states_release(quality)
        panels = [identity_of(plan, panel, quality) for panel in plan]
        return identity(panels, {path: content_hash(path) for path in paths})
    return panel_identity(name, data_of(plan, name, quality), sources_of(plan[name]))


def sources_of(panel: Panel) -> dict[str, str]:
    """Hashes of what determines a panel besides its results. Raises ConfigurationError, OSError."""
    try:
        return sources_of_panel(panel.script, panel.reads)
    except FileNotFoundError as error:
        raise ConfigurationError(
            f"panel {panel.name} of paper.yaml has no script: write {error.filename}"
        ) from error


def stem_of(name: str, quality: str) -> str:
    """Path of the files of a panel or of the report, without suffix."""
    return f"{FIGURES}/{quality}/{name}"


def record_of(plan: dict[str, Panel], name: str, quality: str) -> str:
    """Path of the record of a panel or of the report, which has its present identity. Raises
    ConfigurationError, OSError."""
    return f"{FIGURES}/{quality}/{record_name(name, identity_of(plan, name, quality))}"


def files_of(plan: dict[str, Panel], name: str, quality: str) -> list[str]:
    """Paths of the files of a panel or of the report, with the record. Raises ConfigurationError, OSError."""
    kinds = ("html",) if name == REPORT else KINDS
    return [*(f"{stem_of(name, quality)}.{kind}" for kind in kinds), record_of(plan, name, quality)]


def rendering_of(plan: dict[str, Panel], name: str, quality: str) -> Job:
    """Job that renders a panel. Raises ConfigurationError, OSError."""
    panel, planned = plan[name], identity_of(plan, name, quality)
    data = data_of(plan, name, quality)
    return Job(panel.script, stem_of(name, quality), data, [*panel.reads], planned)


def _merged(*efforts: dict[str, Any]) -> dict[str, Any]:
    """Later efforts replace earlier ones; of replicas and error the last one given counts."""
    merged: dict[str, Any] = {}
    for effort in efforts:
        if {"replicas", "error"} & effort.keys():
            merged = {key: value for key, value in merged.items() if key not in ("replicas", "error")}
        merged |= effort
    return merged


def _panel(name: str, panel: dict[str, Any], efforts: dict[str, Any], selection: Selection) -> Panel:
    runs, replaced = [], []
    effort_of = efforts.get("panels", {}).get(name, {})
    of_all = {key: value for key, value in effort_of.items() if key in EFFORT_OPTIONS}
    for series, program in programs_of(panel).items():
        if series in effort_of.get("omit", ()):
            continue
        own = dict(panel["series"][series])
        own.pop("program", None)
        replicated, scale = is_sampled(program), own.pop("target-scale", None)
        common_seed = own.pop("common-seed", False)
        general = (efforts["default"], of_all) if replicated else ()
        effort = _merged(*general, effort_of.get(series, {}))
        physics = {**panel.get("common", {}), **own}
        options = {**physics, **effort}
        replaced += [f"{key} of {series}" for key in effort if key in physics]
        listed = [key for key, value in options.items() if isinstance(value, list)]
        for values in itertools.product(*(options[key] for key in listed)):
            chosen = dict(zip(listed, values, strict=True))
            run = "_".join([series, *(f"{key}={value}" for key, value in sorted(chosen.items()))])
            given = {**options, **chosen}
            given = {key: evaluated(value, given.get("cells")) for key, value in given.items()}
            completed = (
                selection.with_effort(name if common_seed else f"{name}/{run}", given, scale)
                if replicated
                else given
            )
            runs.append(Run(run, program, completed, series))
    uses, reads = (tuple(panel.get(key, ())) for key in ("uses", "reads"))
    reads = tuple(path for path in reads if path != NUMBERS or states_release(selection.name))
    beyond = panel.get("beyond", False)
    return Panel(name, panel.get("script", name), tuple(runs), uses, tuple(replaced), reads, beyond)

"""Plan of the configuration: the panels, their runs, and the names of their products."""

import itertools
import re
import shlex
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from workflow.lib import polynomial
from workflow.lib.configuration import (
    FOLDER,
    ConfigurationError,
    Options,
    load_configuration,
    programs_of,
)
from workflow.lib.identity import identity, seed_of
from workflow.lib.nearest import nearest
from workflow.provenance.build_id import built

QUALITIES = ("smoke", "standard", "paper", "deep")
BATCH = 16  # replicas between two checks of a target error
# Without +, as the text is part of the name of a folder and of a pattern of names.
NUMBER = r"[0-9]+\.?[0-9]*|[0-9]*\.?[0-9]+|[0-9]+\.?[0-9]*[eE]-?[0-9]+"
EFFORTS: dict[str, tuple[str, Any, str]] = {  # pattern, type and description of the allowed values
    "seed": ("0|[1-9][0-9]{0,17}", int, "a whole number from 0 to 10^18 - 1"),
    "replicas": ("[1-9][0-9]{0,17}", int, "a whole number, at least 1"),
    "error": (NUMBER, float, "a number greater than 0"),
    "hours": (NUMBER, float, "a number greater than 0"),
}


@cache  # called for many runs
def build_id(program: str) -> str:
    """Build id of a program. Raises BuildError."""
    return str(built(program)["build_id"])


@dataclass(frozen=True)
class Run:
    """One execution of a program, with a name that is unique within its panel."""

    name: str
    program: str
    options: Options
    replicated: bool = True  # False for a deterministic program
    series: str = ""  # key in the configuration; the name also has the listed values
    hours: float | None = None  # wall time of all runs, after which a run with a target error stops
    target: float | None = None  # ERROR: relative error of the target quantity, or error over its scale
    scale: float | None = None  # size of a target quantity that can be 0

    @cached_property
    def identity(self) -> str:
        """Hash of all that determines the result: program, build, options, and a bound on the time. Raises BuildError."""
        bound = [] if self.hours is None else [self.hours]
        return identity(self.program, build_id(self.program), self.options, *bound)


@dataclass(frozen=True)
class Panel:
    """A figure: its own runs, and the names of other panels whose runs it also plots."""

    name: str
    script: str
    runs: tuple[Run, ...]
    uses: tuple[str, ...] = ()

    def run(self, name: str) -> Run:
        return next(run for run in self.runs if run.name == name)


@dataclass(frozen=True)
class Quality:
    """A quality with the effort of the command line, by the name of its folder of figures: `standard`, or
    `standard_seed=7_replicas=200`."""

    name: str
    base: str
    seed: int | None = None
    replicas: int | None = None
    error: float | None = None  # relative standard error of the target quantity of every run
    hours: float | None = None

    @classmethod
    def of(cls, name: str) -> "Quality":
        """Parses the name of the folder. Raises ConfigurationError."""
        base, *given = name.split("_")
        if base not in QUALITIES:
            raise ConfigurationError(f"{base} is not a quality; choose one of {', '.join(QUALITIES)}")
        values: dict[str, Any] = {}
        for key, _, text in (word.partition("=") for word in given):
            if key not in EFFORTS:
                raise ConfigurationError(f"{key}={text} is no effort; {nearest(key, EFFORTS)}")
            if key in values:
                raise ConfigurationError(f"{key}={text} is given more than once; give it once")
            pattern, number, allowed = EFFORTS[key]
            if not re.fullmatch(pattern, text) or (number is float and float(text) == 0):
                raise ConfigurationError(f"{key.upper()}={text} is invalid; allowed: {allowed}")
            values[key] = number(text)
        quality = cls(name, base, **values)
        if quality.error is not None and quality.replicas is not None:
            raise ConfigurationError(
                "ERROR and REPLICAS both determine the number of replicas; give one of them"
            )
        if quality.hours is not None and quality.error is None:
            raise ConfigurationError("HOURS bounds the time to reach an error; give ERROR=0.01, too")
        return quality

    @property
    def arguments(self) -> str:
        """Arguments of make that select this quality and effort."""
        given = {"QUALITY": self.base, **{key.upper(): getattr(self, key) for key in EFFORTS}}
        return " ".join(f"{name}={value}" for name, value in given.items() if value is not None)

    def complete(self, panel: str, run: str, options: Options) -> Options:
        """Adds to the options of a replicated run its seed and, if given, the number of replicas or the target error."""
        if self.replicas is not None or self.error is not None:
            options = {key: value for key, value in options.items() if key != "target-error"}
        if self.replicas is not None:
            options["replicas"] = self.replicas
        if self.error is not None:
            options |= {"replicas": BATCH, "target-error": self.error}
        names = f"{panel}/{run}" if self.seed is None else f"{panel}/{run}/{self.seed}"
        return options | {"seed": seed_of(names)}


def load_plan(name: str, folder: Path = FOLDER) -> dict[str, Panel]:
    """All panels of a quality, by name. Raises ConfigurationError."""
    quality = Quality.of(name)
    paper, efforts = load_configuration(quality.base, folder)
    effort = efforts.content
    panels = {name: _panel(name, panel, effort, quality) for name, panel in paper.content["panels"].items()}
    for panel in panels.values():
        if not panel.runs and not panel.uses:
            text = f"no runs at quality {name}, and no panel whose runs it uses"
            raise ConfigurationError(paper.complaint(("panels", panel.name), text))
        for number, used in enumerate(panel.uses):
            if used not in panels or not panels[used].runs:
                text = f"{used} has no runs; {nearest(used, {*panels} - {panel.name, used})}"
                raise ConfigurationError(paper.complaint(("panels", panel.name, "uses", number), text))
    return panels


def panel_named(plan: dict[str, Panel], name: str) -> Panel:
    """The panel of this name. Raises ConfigurationError with the most similar name."""
    if name in plan:
        return plan[name]
    raise ConfigurationError(f"{name} is not a panel; {nearest(name, plan)}")


def with_used(plan: dict[str, Panel], name: str) -> list[Panel]:
    """Panels whose runs a panel plots: those in `uses`, then itself."""
    return [plan[used] for used in (*plan[name].uses, name)]


def data_path(quality: str, panel: str, run: Run) -> str:
    """Path of a result. Raises BuildError."""
    return f"data/{quality.partition('_')[0]}/{panel}/{run.name}.{run.identity}.h5"


def data_of(plan: dict[str, Panel], name: str, quality: str) -> list[str]:
    """Paths of the results that a panel plots. Raises BuildError."""
    return [data_path(quality, panel.name, run) for panel in with_used(plan, name) for run in panel.runs]


def drawing_command(script: str, stem: str, data: list[str]) -> str:
    """Shell command that renders a panel to stem.*"""
    words = [".venv/bin/python", "-m", f"workflow.figures.{script}", "--output", stem, "--data", *data]
    return shlex.join(words)


def _panel(name: str, panel: dict[str, Any], efforts: dict[str, Any], quality: Quality) -> Panel:
    runs = []
    for series, program in programs_of(panel).items():
        own = dict(panel["series"][series])
        own.pop("program", None)
        replicated = own.pop("replicated", True)
        default = efforts["default"] if replicated else {}
        effort = efforts.get("panels", {}).get(name, {}).get(series, {})
        options = {**panel.get("common", {}), **own, **default, **effort}
        if options.get("replicas") == 0:
            continue
        listed = [key for key, value in options.items() if isinstance(value, list)]
        for values in itertools.product(*(options[key] for key in listed)):
            chosen = dict(zip(listed, values, strict=True))
            run = "_".join([series, *(f"{key}={_in_name(value)}" for key, value in chosen.items())])
            given = {**options, **chosen}
            if "cells" in given:
                given = {key: polynomial.evaluated(value, given["cells"]) for key, value in given.items()}
            completed = quality.complete(name, run, given) if replicated else given
            bound = (quality.hours, quality.error) if replicated else (None, None)
            runs.append(Run(run, program, completed, replicated, series, *bound, given.get("target-scale")))
    return Panel(name, panel.get("script", name), tuple(runs), tuple(panel.get("uses", ())))


def _in_name(value: object) -> str:
    """Value as part of a file name: 1perN for 1/N."""
    return str(value).replace("/", "per")

"""Plan of the configuration: the panels and their runs."""

import hashlib
import itertools
import json
import re
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workflow.lib.configuration import (
    FOLDER,
    ConfigurationError,
    Options,
    load_configuration,
    programs_of,
)
from workflow.lib.nearest import nearest
from workflow.lib.units import option_units

KINDS = ("pdf", "png", "svg", "csv", "json")
QUALITIES = ("smoke", "standard", "paper", "deep")
STOPPING = ("target-error", "target-absolute", "max-replicas")  # options that add replicas to a run


@dataclass(frozen=True)
class Run:
    """One execution of a program, with a name that is unique within its panel."""

    name: str
    program: str
    options: Options
    replicated: bool = True  # False for a deterministic program
    series: str = ""  # key in the configuration; the name also has the listed values


@dataclass(frozen=True)
class Panel:
    """A figure: its own runs, and the names of other panels whose runs it also plots."""

    name: str
    script: str
    runs: tuple[Run, ...]
    uses: tuple[str, ...] = ()

    def run(self, name: str) -> Run:
        return next(run for run in self.runs if run.name == name)

    def hash(self) -> str:
        """sha256 of the configuration of the panel: options, effort, and units of the options."""
        runs = [[run.name, run.program, run.options] for run in self.runs]
        units = {
            name: unit
            for name, unit in option_units().items()
            if any(name in run.options for run in self.runs)
        }
        content = [self.name, self.script, runs, self.uses, units]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


@dataclass(frozen=True)
class Quality:
    """A quality, by the name of its folders: `standard`, or `standard_seed=7_replicas=200` with the seed and number of replicas of
    the command line."""

    name: str
    base: str
    seed: int | None = None
    replicas: int | None = None

    @classmethod
    def of(cls, name: str) -> "Quality":
        """Parses the name of the folders. Raises ConfigurationError."""
        parts = re.fullmatch(r"([a-z]+)(?:_seed=(0|[1-9][0-9]*))?(?:_replicas=([1-9][0-9]*))?", name)
        if not parts or parts[1] not in QUALITIES:
            raise ConfigurationError(f"{name} is not a quality; choose one of {', '.join(QUALITIES)}")
        seed, replicas = (None if part is None else int(part) for part in parts.groups()[1:])
        return cls(name, parts[1], seed, replicas)

    @property
    def arguments(self) -> str:
        """Arguments of make."""
        given = {"QUALITY": self.base, "SEED": self.seed, "REPLICAS": self.replicas}
        return " ".join(f"{name}={value}" for name, value in given.items() if value is not None)

    def complete(self, panel: str, run: str, options: Options) -> Options:
        """Adds to the options of a replicated run its seed and, if given, the number of replicas."""
        if self.replicas is not None:
            options = {key: value for key, value in options.items() if key not in STOPPING}
            options["replicas"] = self.replicas
        return options | {
            "seed": _seed(f"{panel}/{run}" if self.seed is None else f"{panel}/{run}/{self.seed}")
        }


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
    return [plan[one] for one in (*plan[name].uses, name)]


def data_path(quality: str, panel: str, run: str) -> str:
    return f"data/{quality}/{panel}/{run}.h5"


def data_of(plan: dict[str, Panel], name: str, quality: str) -> list[str]:
    """Paths of the result files that a panel plots."""
    return [data_path(quality, panel.name, run.name) for panel in with_used(plan, name) for run in panel.runs]


def drawings_of(quality: str, panel: str) -> list[str]:
    return [f"figures/{quality}/{panel}.{kind}" for kind in KINDS]


def drawing_command(plan: dict[str, Panel], quality: str, name: str, stem: str) -> str:
    """Shell command that renders a panel to stem.*"""
    panel = plan[name]
    words = [".venv/bin/python", "-m", f"workflow.figures.{panel.script}", "--configuration", panel.hash()]
    return shlex.join([*words, "--output", stem, "--data", *data_of(plan, name, quality)])


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
            completed = quality.complete(name, run, given) if replicated else given
            runs.append(Run(run, program, completed, replicated, series))
    return Panel(name, panel.get("script", name), tuple(runs), tuple(panel.get("uses", ())))


def _in_name(value: object) -> str:
    """Value as part of a file name: 1perN for 1/N."""
    return str(value).replace("/", "per")


def _seed(names: str) -> int:
    """Seed from a hash of the names, which gives every run its own reproducible random streams."""
    return int.from_bytes(hashlib.sha256(names.encode()).digest()[:4], "big")

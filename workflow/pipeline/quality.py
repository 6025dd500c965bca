"""The quality of products: one of workflow/config/quality, with an effort of the command line in place of
its own."""

import hashlib
import re
from dataclasses import dataclass
from typing import Any

from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import (
    PANELS,
    ConfigurationError,
    Options,
    merge_efforts,
)

QUALITIES = [path.stem for path in sorted((PANELS[0].parent / "quality").glob("*.yaml"))]
DEFAULT_QUALITY = "standard"
EFFORTS: dict[str, tuple[str, Any, str]] = {  # pattern, type and description of the allowed values
    "seed": ("0|[1-9][0-9]{0,17}", int, "a whole number from 0 to 10^18 - 1"),
    "replicas": ("[1-9][0-9]{0,17}", int, "a whole number, at least 1"),
    "error": (r"[0-9]*\.?[0-9]+(?:[eE]-?[0-9]+)?", float, "a number between 0 and 1, as 0.02 for 2 %"),
}


@dataclass(frozen=True)
class Quality:
    """A file of workflow/config/quality, and the effort of the command line, which replaces that of the
    file. `error` is the relative standard error of the target quantity of every run."""

    file: str
    effort: dict[str, float]

    @classmethod
    def parse(cls, name: str) -> "Quality":
        """Parses the name of the folder. Raises ConfigurationError."""
        base, *given = re.split("_(?=[^_]*=)", name)
        if base not in QUALITIES:
            raise ConfigurationError(f"{base} is not a quality; choose one of {', '.join(QUALITIES)}")
        values: dict[str, Any] = {}
        for key, _, text in (word.partition("=") for word in given):
            if key not in EFFORTS:
                raise ConfigurationError(f"{key}={text} is no effort; {suggestion(key, EFFORTS)}")
            if key in values:
                raise ConfigurationError(f"{key}={text} is given more than once; give it once")
            pattern, number, allowed = EFFORTS[key]
            if not re.fullmatch(pattern, text) or (number is float and not 0 < float(text) < 1):
                raise ConfigurationError(f"{key.upper()}={text} is invalid; give {allowed}")
            values[key] = number(text)
        if "error" in values and "replicas" in values:
            raise ConfigurationError(
                "ERROR and REPLICAS both determine the number of replicas; give one of them"
            )
        return cls(base, {key: values[key] for key in EFFORTS if key in values})

    @property
    def name(self) -> str:
        """Name of its folders of data and figures: `standard`, or `standard_seed=7_replicas=200`."""
        return "_".join([self.file, *(f"{key}={value}" for key, value in self.effort.items())])

    @property
    def arguments(self) -> str:
        """Arguments of make for this quality."""
        return " ".join(
            [f"QUALITY={self.file}", *(f"{key.upper()}={value}" for key, value in self.effort.items())]
        )

    def with_effort(self, names: str, options: Options) -> Options:
        """Options of a sampled run with its effort as options of the program, and its seed. names: of panel
        and run, from which the seed follows."""
        options = merge_efforts(options, {key: value for key, value in self.effort.items() if key != "seed"})
        if "error" in options:
            options["target-error"] = options.pop("error")
        if "seed" in self.effort:
            names = f"{names}/{self.effort['seed']}"
        return options | {"seed": seed_of(names)}


def seed_of(text: str) -> int:
    """Seed from a hash of names, which gives every run its own reproducible random streams."""
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big")

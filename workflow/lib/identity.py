"""Names of results: RUN.IDENTITY.h5, where the identity is a hash of all that determines the result."""

import hashlib
import json
import os
import re
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DIGITS = 12  # 48 bits: two of a million names are equal with a probability of 0.2 %
IDENTITY = f"[0-9a-f]{{{DIGITS}}}"  # regular expression of an identity


def identity_of(*parts: object) -> str:
    """First digits of the sha256 of the parts, values of JSON."""
    return sha256(json.dumps(parts, sort_keys=True).encode())[:DIGITS]


def sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def result_identity(program: str, words: str, sources: str) -> str:
    """Identity of a result. words: options that determine it, as on the command line; sources: their hash,
    from source_hash()."""
    return identity_of(program, words, sources)


def named_identity(path: Path | str) -> str:
    """Identity in the name of a file or of a stem, NAME.IDENTITY; empty for other names."""
    named = re.search(rf"\.({IDENTITY})(\.\w+)?$", str(path))
    return named[1] if named else ""


def panel_of(result: Path | str) -> str:
    """The panel to which a result belongs."""
    return Path(result).parent.name


def run_name(series: str, values: Mapping[str, object]) -> str:
    """Name of a run: its series, and the values chosen of the options that have a list of them."""
    words = [series, *(f"{option}={value}" for option, value in sorted(values.items()))]
    return "_".join(words).replace("/", "over")  # as in cell-length=1/N


def series_of(run: str) -> str:
    """The series in the name of a run."""
    return re.sub(r"_[a-z0-9-]+=.*", "", run)


def run_of(result: Path | str) -> str:
    """The name of the run of a result."""
    return re.sub(rf"\.{IDENTITY}$", "", Path(result).stem)


def siblings(path: Path | str) -> list[Path]:
    """Files that differ from a path at most in the identity, the newest first."""
    pattern = Path(path).name.replace(named_identity(path), DIGITS * "[0-9a-f]")
    return sorted(Path(path).parent.glob(pattern), key=os.path.getmtime, reverse=True)

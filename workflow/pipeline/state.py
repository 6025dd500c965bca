"""The state of a file: current, stale, edited, missing, or not checked."""

from collections.abc import Iterable, Mapping
from enum import StrEnum
from pathlib import Path
from typing import Any, NamedTuple

from workflow.lib.identity import DIGITS, sha256, siblings
from workflow.lib.load import FormatError, load_provenance
from workflow.pipeline.plan import FIGURES, Panel, Run
from workflow.pipeline.sources import sources_changed
from workflow.render.files import format_os_error
from workflow.render.record import read_record, record_name


class State(StrEnum):
    STALE = "stale"
    EDITED = "edited"
    MISSING = "missing"
    NOT_CHECKED = "not checked"


class Fault(NamedTuple):
    """A file that is not current."""

    state: State
    path: str
    reason: str


def fault_of_result(path: str, run: Run) -> Fault | None:
    """Fault of the result of a run. path: the planned one."""
    try:
        load_provenance(path)
    except OSError as error:
        return Fault(State.NOT_CHECKED, path, format_os_error(error))
    except FormatError as error:
        if Path(path).exists():
            return Fault(State.EDITED, path, str(error).removeprefix(path).strip(": "))
        former = [(differences_of_result(run, sibling), str(sibling)) for sibling in siblings(path)]
        if not former:
            return Fault(State.MISSING, path, "it is not there")
        differing, nearest = min(former, key=lambda pair: len(pair[0]))
        return Fault(State.STALE, nearest, ", ".join(differing))
    return None


def faults_of_results(runs: Mapping[str, Run]) -> dict[str, Fault]:
    """Faults by the planned paths."""
    return {path: fault for path, run in runs.items() if (fault := fault_of_result(path, run))}


def fault_of_files(product: Panel) -> Fault | None:
    """Fault of the files of a panel or of the report; the first one represents all."""
    record, path = product.record, product.record_path
    if not record and Path(path).exists():
        return Fault(State.EDITED, path, "it is damaged; remove it")
    if not record:
        former = next(filter(None, map(read_record, siblings(path))), None)
        if former is None:
            return Fault(State.MISSING, path, "it is not there")
        return Fault(State.STALE, product.files[0], differences(product, former))
    for suffix, digest in record["files"].items():
        file = f"{product.stem}.{suffix}"
        if not Path(file).exists():
            return Fault(State.MISSING, file, "it is not there")
        if sha256(Path(file).read_bytes()) != digest:
            return Fault(State.EDITED, file, f"it differs from its hash in {path}; remove it")
    return None


def faults_of_files(products: Iterable[Panel]) -> dict[str, Fault]:
    """Faults by the names of panels."""
    return {product.name: fault for product in products if (fault := fault_of_files(product))}


def is_made(product: Panel) -> bool:
    """Whether there is a file of it, also of a former one."""
    folder, record = Path(FIGURES, product.quality), record_name(product.name, DIGITS * "[0-9a-f]")
    return Path(f"{product.stem}.{product.formats[0]}").exists() or any(folder.glob(record))


def differences_of_result(run: Run, sibling: Path) -> list[str]:
    """Options and sources that differ between a run and a former result."""
    try:
        former = load_provenance(sibling)
    except (FormatError, OSError) as error:
        return [str(error)]
    was, now = options_of(former["option_words"]), options_of(run.options_text)
    differing = [f"it has {option}" for option in was if option not in now]
    differing += [f"planned is {option}" for option in now if option not in was]
    return [*differing, f"sources of {run.program} have changed"] if sources_changed(former) else differing


def options_of(words: str) -> list[str]:
    """Options, each with its value, from the words of a command line."""
    return [f"--{option.strip()}" for option in words.split("--")[1:]]


def differences(product: Panel, former: Mapping[str, Any]) -> str:
    """What differs from a former record: sources by their paths; results or figures."""
    now, was = product.sources, former.get("sources", {})
    differing = [path for path in {**now, **was} if now.get(path) != was.get(path)]
    results = [] if product.parents == former.get("parents") else ["results"]
    return f"changed: {', '.join(differing + results)}"

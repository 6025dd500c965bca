"""What products say of themselves, against what the lock says of them."""

from workflow.provenance.layout import faults
from workflow.provenance.lock import Job
from workflow.provenance.parents import ArtefactError, Parents
from workflow.provenance.repository import ROOT
from workflow.scripts.load import Result, load

BUILT = ("source_hash", "compiler", "flags", "libraries")


def run_fault(path: str, job: Job, builds: dict[str, dict]) -> str | None:
    """Of a result file: the first contradiction with the documented layout or with the lock."""
    if found := faults(ROOT / path):
        return found[0].removeprefix(f"{ROOT / path}: ")
    result = load(ROOT / path)
    build = builds[job.parents["build_id"]]
    wanted = {name: build[name] for name in BUILT}
    wanted |= {name: job.parents[name] for name in ("program", "build_id")}
    for name, value in wanted.items():
        if result.provenance[name] != value:
            return f"says {name} {result.provenance[name]}, not {value}"
    return _parameter_fault(result, job.parents["arguments"])


def _parameter_fault(result: Result, arguments: str) -> str | None:
    """The first option of the command line that the file gives another value. Multiples of N stand in the file
    as numbers, so they are not compared."""
    for option in arguments.split("--")[1:]:
        name, _, text = option.strip().partition(" ")
        value = result.parameters.get(name)
        if value is None or text == "":
            continue
        try:
            differs = value != text.strip("'") if isinstance(value, str) else float(value) != float(text)
        except ValueError:
            continue
        if differs:
            return f"says --{name} {value}, not {text}"
    return None


def drawing_fault(path: str, job: Job) -> str | None:
    """Of a figure's file: the first contradiction with the lock."""
    try:
        named = vars(Parents.of(ROOT / path))
    except ArtefactError as error:
        return str(error)
    differing = [name for name, value in named.items() if value != job.parents.get(name)]
    return f"names other parents than the lock: {differing[0]}" if differing else None

"""Renders panels: loads the results of each, calls its script and saves what that returns.

`python -m workflow.lib.render JOB ...`, each a Job as JSON. Every panel is rendered by a process of its own,
so that one that fails takes no other with it; all are forks of this one, which has imported the packages.
"""

import io
import json
import multiprocessing
import os
import signal
import sys
import traceback
from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import h5py
import matplotlib.pyplot as plt

from workflow.lib import style
from workflow.lib.caption import with_doubts
from workflow.lib.columns import TableError, as_csv, inherited
from workflow.lib.figure import Plot, TheoryError
from workflow.lib.identity import ROOT, SHARED, panel_identity, sources_of_panel
from workflow.lib.job import Job
from workflow.lib.load import FormatError, Result, cost_file, load
from workflow.lib.save import FORMATS, Parents, Text, save
from workflow.lib.units import UnitsError

LIBRARIES = (".venv", ".cache")  # uv.lock determines the packages; the cache changes no figure
opened: set[str] = set()  # files that the script reads


class UndeclaredError(ValueError):
    """A script uses a file on which the identity of its panel does not depend."""


class EditedError(ValueError):
    """Results or sources of a panel have changed since it was planned."""


def render(job: Job) -> None:
    """Writes the files of a panel. Raises FormatError, OSError, TheoryError, UndeclaredError, UnitsError,
    TableError, EditedError."""
    sources = sources_of_panel(job.script, job.reads)
    identity = panel_identity(job.panel, job.data, sources)
    if job.identity not in (identity, ""):
        raise EditedError(f"{', '.join(sources)}: one of these was edited meanwhile: repeat the command")
    data = [*map(Path, job.data)]
    results = load_all(data)
    sys.addaudithook(_note_opened)
    h5py.h5f.open = _open_hdf5
    script = import_module(f"workflow.figures.{job.script}")
    style.apply()
    figure, table, caption = script.draw(results)
    costs = [*map(cost_file, data)]
    require_declared(job.panel, Path(str(script.__file__)), [*data, *costs, *map(Path, job.reads)])
    units = getattr(script, "UNITS", {})
    errors = {f"{column}_error": text for column, text in units.items()}
    numbers = as_csv(table, inherited(results) | errors | units)
    shown = script.draw.shown(results) if isinstance(script.draw, Plot) else results
    whole = with_doubts(" ".join(caption.split()), shown)
    title = script.title(shown) if hasattr(script, "title") else script.TITLE
    text = Text(" ".join(title.split()), whole)
    doubts = {str(result.path): result.doubts for result in results if result.doubts}
    save(figure, numbers, Path(job.stem), text, Parents(identity, data, sources, doubts))


def load_all(paths: Sequence[Path]) -> list[Result]:
    """Results of a panel. Raises FormatError for all that are refused, OSError."""
    results, refused = [], []
    for path in paths:
        try:
            results.append(load(path))
        except FormatError as error:
            refused.append(str(error))
    if refused:
        raise FormatError("\n".join(refused))
    return results


def require_declared(panel: str, script: Path, allowed: Iterable[Path]) -> None:
    """Raises UndeclaredError if the script has read or imported another file of the project."""
    modules = [getattr(module, "__file__", None) for module in [*sys.modules.values()]]
    files = sorted({Path(os.path.abspath(file)) for file in (*opened, *modules) if file})
    free = [ROOT / name for name in (*SHARED, *LIBRARIES)]
    free += [Path(os.path.abspath(path)) for path in (script, *allowed)]
    for file in files:
        own = file.is_relative_to(ROOT) and file.suffix != ".pyc" and file.name != "__init__.py"
        if own and file.is_file() and not any(file.is_relative_to(path) for path in free):
            name = file.relative_to(ROOT)
            remedy = f"add `reads: [{name}]` to {panel} in workflow/config/paper.yaml"
            if file.suffix == ".py":
                remedy = "move what it takes from there to workflow/lib or workflow/physics"
            raise UndeclaredError(
                f"{script.name} uses {name}, on which the identity of {panel} does not depend: {remedy}"
            )


def _note_opened(event: str, arguments: tuple[Any, ...]) -> None:
    if event == "open" and isinstance(arguments[0], str) and not arguments[2] & (os.O_WRONLY | os.O_CREAT):
        opened.add(arguments[0])


def _open_hdf5(name: bytes, *arguments: Any, original: Any = h5py.h5f.open, **named: Any) -> Any:
    """HDF5 opens files itself, and Python reports no event."""
    opened.add(os.fsdecode(name))
    return original(name, *arguments, **named)


def failure(job: Job) -> tuple[str, str]:
    """Renders a panel. Returns its name, and why it failed, "" if it did not."""
    try:
        render(job)
    except (FormatError, OSError, TheoryError, UndeclaredError, UnitsError, TableError, EditedError) as error:
        return job.panel, str(error)
    except Exception:
        return job.panel, traceback.format_exc().strip()  # a mistake in the script
    return job.panel, ""


def warm_up() -> None:
    """Draws a text in every format: what matplotlib loads for it, a fifth of the time of a panel, is then
    shared by all forks."""
    style.apply()
    figure, axes = plt.subplots()
    axes.set_title("$x^2_1$")
    for kind in FORMATS:
        figure.savefig(io.BytesIO(), format=kind)
    plt.close(figure)


def main(words: Sequence[str]) -> int:
    """Exit status: 0, 1 if a panel could not be rendered."""
    jobs, failed = [Job(**json.loads(word)) for word in words], False
    processes = min(len(jobs), len(os.sched_getaffinity(0)))
    if len(jobs) > processes:
        warm_up()
    ignore = (signal.SIGINT, signal.SIG_IGN)  # Ctrl-C ends this process, which ends the others
    context = multiprocessing.get_context("fork")
    with context.Pool(processes, signal.signal, ignore, maxtasksperchild=1) as pool:
        for panel, reason in pool.imap_unordered(failure, jobs, chunksize=1):
            print(f"{panel}: {reason or 'rendered'}", file=sys.stderr if reason else sys.stdout, flush=True)
            failed = failed or bool(reason)
    return int(failed)


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)

"""Renders a panel: loads its results, calls its script and saves what that returns.

`python -m workflow.render JOB`, the arguments of render() as JSON. Exit status: 0, 1 if it fails, with the
reason on stderr.
"""

import json
import os
import sys
import traceback
from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import h5py

from workflow.lib import style
from workflow.lib.caption import with_doubts
from workflow.lib.columns import TableError, as_csv, inherited
from workflow.lib.figure import NoValueError, Plot, TheoryError
from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError, Result, cost_file, load
from workflow.lib.units import UnitsError
from workflow.render.files import format_os_error
from workflow.render.frame import with_outside
from workflow.render.record import SHARED, panel_identity, sources_of_panel
from workflow.render.save import Parents, Text, save

LIBRARIES = (".venv", ".cache")  # uv.lock determines the packages; the cache changes no figure
opened: set[str] = set()  # files that the script reads


class UndeclaredError(ValueError):
    """A script uses a file on which the identity of its panel does not depend."""


class EditedError(ValueError):
    """Results or sources of a panel have changed since it was planned."""


def render(
    script: str, stem: str, results: Sequence[str], inputs: Sequence[str] = (), planned: str = ""
) -> None:
    """Writes the files of a panel. script: its path; stem: FOLDER/QUALITY/PANEL; results: paths; inputs: other
    files and folders that the script uses; planned: identity of the panel, "" if none is planned. Raises
    REFUSED, OSError."""
    panel, sources = Path(stem).name, sources_of_panel(script, inputs)
    identity = panel_identity(panel, results, sources)
    if planned not in (identity, ""):
        raise EditedError(f"{', '.join(sources)}: one of these was edited meanwhile: repeat the command")
    paths = [*map(Path, results)]
    loaded = load_all(paths)
    sys.addaudithook(_note_opened)
    h5py.h5f.open = _open_hdf5
    module = import_module(script.removesuffix(".py").replace("/", "."))
    style.apply()
    figure, table, caption = module.draw(loaded)
    require_declared(panel, Path(script), [*paths, *map(cost_file, paths), *map(Path, inputs)])
    units = getattr(module, "UNITS", {})
    errors = {f"{column}_error": text for column, text in units.items()}
    numbers = as_csv(table, inherited(loaded) | errors | units)
    shown = module.draw.shown(loaded) if isinstance(module.draw, Plot) else loaded
    whole = with_doubts(with_outside(" ".join(caption.split()), figure), shown)
    title = module.title(shown) if hasattr(module, "title") else module.TITLE
    text = Text(" ".join(title.split()), whole)
    doubts = {str(result.path): result.doubts for result in loaded if result.doubts}
    save(figure, numbers, Path(stem), text, Parents(identity, paths, sources, doubts))


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
            remedy = f"add `inputs: [{name}]` to {panel} in workflow/config/paper.yaml"
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


REFUSED = (FormatError, NoValueError, TheoryError, UndeclaredError, UnitsError, TableError, EditedError)


def main(job: str) -> int:
    try:
        render(**json.loads(job))
    except OSError as error:
        print(format_os_error(error), file=sys.stderr)
    except REFUSED as error:
        print(error, file=sys.stderr)
    except Exception as error:  # a mistake in the script; the last line is printed by make
        traceback.print_exc()
        last = traceback.extract_tb(error.__traceback__)[-1]
        print(
            f"{os.path.relpath(last.filename)}:{last.lineno}: {type(error).__name__}: {error}",
            file=sys.stderr,
        )
    else:
        return 0
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

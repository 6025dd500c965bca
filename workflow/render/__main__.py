"""Renders a panel: loads its results, calls its script and saves what that returns.

`python -m workflow.render < JOB`, the arguments of render() as JSON. Exit status: 0, 1 if it fails, with the
reason on stderr.
"""

import json
import os
import sys
import traceback
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import quoted, warnings
from workflow.lib.columns import TableError, as_csv, inherited
from workflow.lib.figure import NoValueError, Plot, TheoryError
from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError, Result, load
from workflow.lib.units import UnitsError
from workflow.physics import run_parameters, setting
from workflow.render.files import format_os_error
from workflow.render.frame import outside
from workflow.render.record import panel_identity, sources_of_panel
from workflow.render.save import Parents, Text, save


class EditedError(ValueError):
    """Results or sources of a panel have changed since it was planned."""


def render(
    script: str, stem: str, results: Sequence[str], inputs: Sequence[str] = (), planned: str = ""
) -> None:
    """Writes the files of a panel. script: its path; stem: FOLDER/QUALITY/PANEL; results: paths; inputs:
    other files and folders that the script uses; planned: identity of the panel, "" if none is planned.
    Raises REFUSED, OSError."""
    panel, sources = Path(stem).name, sources_of_panel(script, inputs)
    identity = panel_identity(panel, results, sources)
    if planned not in (identity, ""):
        raise EditedError(f"{', '.join(sources)}: one of these was edited meanwhile: repeat the command")
    paths = [*map(Path, results)]
    loaded = load_all(paths)
    figure, csv, text = draw(script, loaded)
    warned = {str(result.path): result.warnings for result in loaded if result.warnings}
    save(figure, csv, Path(stem), text, Parents(identity, paths, sources, warned))


def draw(script: str, loaded: Sequence[Result]) -> tuple[Figure, str, Text]:
    """Figure, table as CSV, and text of a panel from its script. Raises REFUSED."""
    module = import_module(script.removesuffix(".py").replace("/", "."))
    shown, others = loaded, []
    if isinstance(module.draw, Plot):
        shown, others = module.draw.shown(loaded), module.draw.not_shown(loaded)
        setting.require_one_value(shown, script, module.draw.varied)
    style.apply()
    figure, table, caption = module.draw(loaded)
    units = getattr(module, "UNITS", {})
    errors = {f"{column}_error": text for column, text in units.items()}
    csv = as_csv(table, inherited(loaded) | errors | units)
    added = [f"Not plotted: series {quoted(others)}."] if others else []
    whole = " ".join([caption, *added, *outside(figure), *warnings(shown)])
    parameters = "" if getattr(module, "LABELLED", False) else setting.sentences(shown, script)
    title = module.TITLE.replace("{gamma}", run_parameters.gamma(loaded[-1]))
    return figure, csv, Text(title, " ".join(whole.split()), parameters)


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


REFUSED = (FormatError, NoValueError, TheoryError, UnitsError, TableError, EditedError)


def is_own(file: str) -> bool:
    """Whether a file is of the project, and not of its packages."""
    path = Path(file)
    return path.is_relative_to(ROOT) and not path.is_relative_to(ROOT / ".venv")


def main() -> int:
    try:
        render(**json.load(sys.stdin))
    except OSError as error:
        print(format_os_error(error), file=sys.stderr)
    except REFUSED as error:
        print(error, file=sys.stderr)
    except Exception as error:  # a mistake in the script; the last line is printed by make
        traceback.print_exc()
        # The last line of the project's or the user's own files, not of a library.
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if is_own(frame.filename)]
        where = f"{os.path.relpath(frames[-1].filename)}:{frames[-1].lineno}: "
        print(f"{where}{type(error).__name__}: {error}", file=sys.stderr)
    else:
        return 0
    return 1


if __name__ == "__main__":
    sys.exit(main())

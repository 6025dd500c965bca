"""Units of the columns of a table, written in the line `# units: ` of its CSV.

A column has the units of the quantity, error (`kappa_error`), axis or option that it is named after. A script
declares the units of its other columns.
"""

import io
import json
from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd
from pandas.api.types import is_bool_dtype, is_integer_dtype, is_scalar

from workflow.lib.load import Result
from workflow.lib.units import UnitsError, parse

UNITS_LINE = "# units: "

# Units that differ between rows are given as this prefix and the name of the column that contains them.
BY_ROW = "column "


def inherited(results: Sequence[Result]) -> dict[str, str]:
    """Units by name from the result files, without names that have several units."""
    by_name: dict[str, set[str]] = defaultdict(set)
    by_name["replicas"] = {"1"}  # no parameter of results with a target error
    for result in results:
        for name, quantity in result.quantities.items():
            by_name[name].add(quantity.units)
            by_name[f"{name}_error"].add(quantity.units)
            for axis, units in quantity.axis_units.items():
                by_name[axis].add(units)
        for option in result.parameters:
            for name in (option, option.replace("-", "_")):
                by_name[name].add(result.parameter_units.get(option, "1"))
    return {name: units.pop() for name, units in by_name.items() if len(units) == 1}


class TableError(ValueError):
    """A table would lose a number or a label in its CSV."""


def as_csv(table: pd.DataFrame, known: Mapping[str, str]) -> str:
    """The table as CSV after the line of units. Raises UnitsError for a column of numbers without valid
    units, TableError if the CSV would not be read as the table."""
    text = as_text(table)
    return f"{UNITS_LINE}{json.dumps(_units(table, known))}\n{text}"


def as_text(table: pd.DataFrame, digits: int = 12) -> str:
    """The table as CSV, with so many digits. In a column with fractions whole numbers have a point, too, and
    labels among which some are numbers begin with the name of the column, as gamma=1 and gamma=N: programs
    that read the text find the type of a column by its first rows. Raises TableError if the text would not
    be read as the table."""

    def number(value: float) -> str:
        text = f"{value:.{digits}g}"
        return f"{text}.0" if text.removeprefix("-").isdigit() else text

    _require_columns(table)
    table = table.infer_objects()
    named = {
        name: [_named(name, cell) for cell in cells] for name, cells in table.items() if _has_number(cells)
    }
    text = table.assign(**named).to_csv(index=False, float_format=number, lineterminator="\n")
    _require_no_loss(table, text)
    return text


def _require_columns(table: pd.DataFrame) -> None:
    """Raises TableError for an index or for columns that a CSV cannot hold."""
    if table.index.nlevels > 1 or table.index.name is not None or not is_integer_dtype(table.index):
        raise TableError("the index of the table is not written: return table.reset_index()")
    if table.columns.nlevels > 1 or not all(isinstance(name, str) for name in table.columns):
        raise TableError(f"columns need names of one word each: rename {', '.join(map(str, table.columns))}")
    if not table.columns.is_unique:
        raise TableError(f"two columns have the same name: {', '.join(map(str, table.columns))}")
    for name, cells in table.items():
        if not all(map(is_scalar, cells)):
            raise TableError(
                f"cells of the column {name} are no single numbers: give each a row, as explode()"
            )
        if any(isinstance(cell, complex) for cell in cells):
            raise TableError(f"the column {name} has complex numbers: give both parts a column")


def _require_no_loss(table: pd.DataFrame, text: str) -> None:
    """Raises TableError if read_csv(comment="#") finds missing values elsewhere."""
    if "#" in text:
        raise TableError("# begins a comment in the CSV: choose another name for a column or label")
    read = pd.read_csv(io.StringIO(text))
    missing = read.isna().to_numpy() != table.isna().to_numpy()
    for name in table.columns[missing.any(axis=0)]:
        raise TableError(f"a label in the column {name} would be read as missing: choose other words")


def _has_number(cells: pd.Series) -> bool:
    """Whether a column of labels has a number, or a word that would be read as one."""
    return any(isinstance(cell, str) for cell in cells) and any(map(_is_number, cells.dropna()))


def _is_number(cell: object) -> bool:
    try:
        float(str(cell))
    except ValueError:
        return False
    return True


def _named(name: str, cell: Any) -> Any:
    return cell if pd.isna(cell) else f"{name}={cell}" if isinstance(cell, str) else f"{name}={cell:g}"


def _is_label(column: pd.Series) -> bool:
    """Whether a column has text or truth values in any row: gamma is N or a number."""
    return is_bool_dtype(column) or any(isinstance(value, str | bool) for value in column)


def _units(table: pd.DataFrame, known: Mapping[str, str]) -> dict[str, str]:
    numbers = [name for name in table if not _is_label(table[name])]
    without = [name for name in numbers if name not in known]
    if without:
        raise UnitsError(
            f"the columns {', '.join(without)} have no units; name them after a quantity, or declare their units in the "
            f"script: UNITS = {json.dumps(dict.fromkeys(without, '1'))}"
        )
    units = {name: known[name] for name in numbers}
    for name, text in units.items():
        for unit in table[text.removeprefix(BY_ROW)].unique() if text.startswith(BY_ROW) else [text]:
            try:
                parse(unit)
            except UnitsError as error:
                raise UnitsError(f"column {name}: {error}") from error
    return units

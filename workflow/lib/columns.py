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
from pandas.api.types import is_bool_dtype, is_integer_dtype

from workflow.lib.load import Result
from workflow.lib.units import UnitsError, parse

UNITS_LINE = "# units: "


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
    """A CSV would not be read as the table."""


def as_csv(table: pd.DataFrame, known: Mapping[str, str]) -> str:
    """The table as CSV after the line of units. Raises UnitsError for a column of numbers without valid
    units, TableError if the CSV would not be read as the table."""
    text = as_text(table)
    return f"{UNITS_LINE}{json.dumps(_units(table, known))}\n{text}"


def as_text(table: pd.DataFrame, digits: int = 12) -> str:
    """The table as CSV, with so many digits. Labels among which some are numbers begin with the name of the
    column, as gamma=1 and gamma=N. Raises TableError if the text would not be read as the table."""
    table = table.infer_objects()
    for name in table.columns[[_has_number(cells) for _, cells in table.items()]]:
        table = table.assign(**{name: [_named(name, cell) for cell in table[name]]})
    text = table.to_csv(index=False, float_format=f"%.{digits}g", lineterminator="\n")
    if table.index.name is not None or not is_integer_dtype(table.index):
        raise TableError("the index of the table is not written: return table.reset_index()")
    try:
        read = pd.read_csv(io.StringIO(text), comment="#")
        same = {"check_dtype": False, "check_index_type": False, "rtol": 10.0 ** (1 - digits)}
        pd.testing.assert_frame_equal(read, table.reset_index(drop=True), **same)
    except (AssertionError, ValueError) as error:
        raise TableError(f"the CSV would be read as another table: {' '.join(str(error).split())}") from error
    return text


def _has_number(cells: pd.Series) -> bool:
    """Whether a column of labels has a number, or a word that would be read as one."""
    labels = cells.map(type).eq(str).any()
    return bool(labels and pd.to_numeric(cells, errors="coerce").notna().any())


def _named(name: str, cell: Any) -> Any:
    return cell if pd.isna(cell) else f"{name}={cell}" if isinstance(cell, str) else f"{name}={cell:.12g}"


def _is_label(column: pd.Series) -> bool:
    """Whether a column has text or truth values in any row: gamma is N or a number."""
    return is_bool_dtype(column) or any(isinstance(value, str | bool) for value in column)


def _units(table: pd.DataFrame, known: Mapping[str, str]) -> dict[str, str]:
    numbers = [name for name in table if not _is_label(table[name])]
    without = [name for name in numbers if name not in known]
    if without:
        raise UnitsError(
            f"the columns {', '.join(without)} have no units; name them after a quantity, or declare their "
            f"units in the script: UNITS = {json.dumps(dict.fromkeys(without, '1'))}"
        )
    units = {name: known[name] for name in numbers}
    for name, unit in units.items():
        try:
            parse(unit)
        except UnitsError as error:
            raise UnitsError(f"column {name}: {error}") from error
    return units

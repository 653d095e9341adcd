"""Reports: results as the command line prints them, as dictionaries and as data frames."""

import json
import warnings
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from . import _core
from ._table import escaped, html_table

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Estimate:
    """A mean over scenes with its error."""

    mean: float
    standard_error: float | None
    interval95: tuple[float, float] | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Report:
    """A result with the settings that it depends on. Printed, it is the table of the command line."""

    text: str = field(compare=False)
    """The table of the command line."""
    _values: dict[str, Any] = field(compare=False)
    _columns: list[str] = field(compare=False)
    _rows: list[list[Any]] = field(compare=False)

    def to_dict(self) -> dict[str, Any]:
        """The command line's JSON: numbers, words, lists and dictionaries."""
        return deepcopy(self._values)

    def to_pandas(self) -> "pd.DataFrame":
        """The command line's CSV as a data frame of pandas; unknown values are NaN or None.

        Raises:
            ImportError: pandas is not installed.
        """
        return data_frame(self._columns, self._rows)

    def __repr__(self) -> str:
        return self.text.rstrip("\n")

    def _repr_html_(self) -> str:
        heading, _, _ = self.text.partition("\n\n")
        columns, rows = self._shown()
        return html_table(heading, columns, rows) if columns else f"<pre>{escaped(self.text)}</pre>"

    def _shown(self) -> tuple[Sequence[str], Sequence[Sequence[Any]]]:
        """The columns and rows of the table in a notebook."""
        return self._columns, self._rows


def data_frame(columns: list[str], rows: Any) -> "pd.DataFrame":
    """A data frame of rows or of an array.

    Raises:
        ImportError: pandas is not installed.
    """
    try:
        import pandas as pd
    except ImportError as error:
        raise ImportError(
            "to_pandas needs pandas, which is not installed; `pip install pandas`, or use to_dict"
        ) from error
    return pd.DataFrame(rows, columns=columns)


def views(found: "_core.Views", *, stacklevel: int = 3) -> dict[str, Any]:
    """The arguments of `Report` from a report of the core, whose warnings are given.

    `stacklevel` leads to the caller of the function that calls this one.
    """
    for warning in found["warnings"]:
        warnings.warn(warning, stacklevel=stacklevel)
    return {
        "text": found["text"],
        "_values": json.loads(found["json"]),
        "_columns": found["columns"],
        "_rows": found["rows"],
    }


def pair(interval: list[float] | None) -> tuple[float, float] | None:
    """The ends of an interval."""
    return None if interval is None else (interval[0], interval[1])


def estimate(values: dict[str, Any]) -> Estimate:
    """An estimate of the JSON."""
    return Estimate(**{**values, "interval95": pair(values["interval95"])})

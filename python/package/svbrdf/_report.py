"""Reports: the JSON of the command line with its keys as attributes, its text and its CSV."""

import io
import json
import warnings
from collections.abc import Callable, Iterator, Mapping
from copy import deepcopy
from functools import cache
from types import UnionType
from typing import TYPE_CHECKING, Any, TypeVar, get_args, get_origin, get_type_hints

from . import _core
from ._scenes import Scene, scene_from

if TYPE_CHECKING:
    import pandas as pd

_R = TypeVar("_R", bound="Report")


class Record(Mapping[str, Any]):
    """An object of a report's JSON, read-only: its keys are attributes, too. Lists are tuples."""

    def __init__(self, values: dict[str, Any], entry: Any = None) -> None:
        """`entry` is the type of values that the class does not name."""
        self.__dict__.update(_values=values, _entry=entry)

    def to_dict(self) -> dict[str, Any]:
        """The command line's JSON: numbers, words, lists and dictionaries."""
        return deepcopy(self._values)

    def __getitem__(self, key: str) -> Any:
        return _frozen(self._values[key], _types(type(self)).get(key, self._entry))

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __eq__(self, other: object) -> bool:
        return bool(self._values == (other._values if isinstance(other, Record) else other))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in self.items())})"

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{type(self).__name__}.{name}: reports are read-only; to_dict() is a copy to change")

    # The types of reports declare the attributes: mypy finds one that does not exist.
    if TYPE_CHECKING:
        _values: dict[str, Any]
        _entry: Any
    else:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or (name not in self._values and name not in _types(type(self))):
                known = ", ".join(self.__dict__.get("_values", ()))
                raise AttributeError(f"{type(self).__name__} has no attribute {name!r}; it has: {known}")
            # The JSON leaves some keys out where they do not apply.
            return self.__dict__.setdefault(name, self[name] if name in self._values else None)


class Report(Record):
    """A result with the settings that it depends on. Printed, it is the table of the command line."""

    text: str
    """The table of the command line."""
    if TYPE_CHECKING:
        _views: _core.Views

    def __init__(self, views: "_core.Views", **arrays: Any) -> None:
        super().__init__(json.loads(views["json"]))
        self.__dict__.update(text=views["text"], _views=views, **arrays)

    def to_pandas(self) -> "pd.DataFrame":
        """The command line's CSV as a data frame of pandas; unknown values are NaN.

        Raises:
            ImportError: pandas is not installed.
        """
        return pandas().read_csv(io.StringIO(self._views["csv"]), float_precision="round_trip")

    def __repr__(self) -> str:
        return self.text.rstrip("\n")

    def _repr_html_(self) -> str:
        return self._views["html"]


def report_of(kind: type[_R], views: "_core.Views", *, stacklevel: int = 3, **arrays: Any) -> _R:
    """A report of the core, whose warnings are given.

    `stacklevel` leads to the caller of the function that calls this one.
    """
    for warning in views["warnings"]:
        warnings.warn(warning, stacklevel=stacklevel)
    return kind(views, **arrays)


def pandas() -> Any:
    """The module, with an error that says how to get it."""
    try:
        import pandas as pd
    except ImportError as error:
        raise ImportError(
            "to_pandas needs pandas, which is not installed; `pip install pandas`, or use to_dict"
        ) from error
    return pd


_types: Callable[[type], dict[str, Any]] = cache(get_type_hints)


def _frozen(value: Any, kind: Any) -> Any:
    """A value of the JSON in its type: an object is of the class that it names, or a record."""
    kinds = get_args(kind) if isinstance(kind, UnionType) else (kind,)
    entry = {get_origin(one): get_args(one) for one in kinds}
    if isinstance(value, list):
        one = entry.get(tuple, (None,))[0]
        return tuple(_frozen(item, one) for item in value)
    if not isinstance(value, dict):
        return value
    if Scene in kinds:
        return scene_from(value)
    named = next((one for one in kinds if isinstance(one, type) and issubclass(one, Record)), Record)
    return named(value, *entry.get(Mapping, (None, None))[1:])

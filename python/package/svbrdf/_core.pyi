"""The extension module. Use the package `svbrdf` instead: this interface is not stable."""

from collections.abc import Mapping
from typing import Any, Literal, TypedDict

__version__: str

class Error(ValueError):
    """Input that cannot be used. The text says where, what was expected, what was found and what to do."""

class CoreMaterial:
    def __init__(self, arrays: Mapping[str, Any], precision: str) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def precision(self) -> Literal["f32", "f64"]: ...
    def map(self, name: str) -> Any: ...

class Views(TypedDict):
    json: str
    text: str
    csv: str
    html: str
    warnings: list[str]

# The functions, which take and return plain values.
def __getattr__(name: str) -> Any: ...

"""The extension module. Use the package `svbrdf` instead: this interface is not stable."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

__version__: str

class Error(ValueError):
    """Input that cannot be used. The text says where, what was expected, what was found and what to do."""

SceneTuple = tuple[str, Sequence[float], Sequence[float]]
Report = Callable[[int, int], object] | None
Precision = Literal["f32", "f64"]

class CoreMaterial:
    @staticmethod
    def from_arrays(arrays: Mapping[str, Any], precision: str, storage: str | None) -> CoreMaterial: ...
    @property
    def storage(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def precision(self) -> Precision: ...
    def map(self, name: str) -> bytearray: ...
    def overview(self) -> str: ...

class Found(TypedDict):
    material: CoreMaterial
    notes: list[str]
    assumptions: list[list[str]]
    files: list[Any]
    options: str

def read(path: str | PathLike[str], options: str, precision: str, strict: bool, progress: Report) -> Found: ...
def write(
    material: CoreMaterial,
    path: str | PathLike[str],
    files: Sequence[str | PathLike[str]],
    depth: str | None,
    preset: str | None,
    preview: bool,
) -> str | None: ...
def built_in(precision: str) -> list[CoreMaterial]: ...
def render(material: CoreMaterial, scene: SceneTuple, convention: str) -> bytearray: ...
def distinct_names(named: Sequence[tuple[str, str]]) -> list[str]: ...
def conventions() -> list[dict[str, Any]]: ...
def sample_scenes(near: int, distant: int, seed: int, sampler: str, convention: str) -> list[SceneTuple]: ...
def named_scenes(name: str, fov: float | None) -> list[SceneTuple]: ...
def read_scenes(path: str | PathLike[str]) -> list[SceneTuple]: ...

class Views(TypedDict):
    json: str
    text: str
    columns: list[str]
    rows: list[list[str | int | float | bool | None]]
    shown: tuple[str, list[str], list[list[str]], str]
    warnings: list[str]

class MapItems(TypedDict):
    views: Views
    maps: list[bytearray]
    standard_errors: list[bytearray]
    directions: bytearray | None

# Of a ground truth, its predictions, the arguments that comparisons have in common and further ones, the progress last.
loss: Callable[..., Views]
rank: Callable[..., Views]
analysis: Callable[..., Views]
diagnose: Callable[..., Views]
map: Callable[..., MapItems]

def photo(materials: Sequence[CoreMaterial], asked: Mapping[str, Any], progress: Report) -> Views: ...
def rank_dataset(asked: Mapping[str, Any], progress: Report) -> Views: ...

class PageItems(TypedDict):
    html: str
    warnings: list[str]

def page(
    ground_truth: CoreMaterial,
    predictions: Sequence[CoreMaterial],
    asked: Mapping[str, Any],
    of_page: Mapping[str, Any],
    progress: Report,
) -> PageItems: ...
def session(
    path: str | PathLike[str],
    materials: Sequence[tuple[str | PathLike[str], str | None]],
    scene: SceneTuple,
    convention: str,
) -> str: ...
def probes() -> list[tuple[str, list[int], list[float]]]: ...
def conform(arrays: Sequence[tuple[str, list[int], list[float]]], convention: str, metallic: bool | None) -> Views: ...

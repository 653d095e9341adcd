"""The arguments that the comparisons have in common."""

import json
import operator
import os
from collections.abc import Sequence
from typing import Any, Literal, TypedDict, TypeVar

from numpy.typing import ArrayLike

from . import _core
from ._arrays import Precision, as_mask
from ._material import Material, Source, opened
from ._progress import Report as Progress
from ._progress import reported
from ._report import Report, report_of
from ._scenes import Scene

Scenes = Sequence[Scene] | Source
Predictions = Material | Source | Sequence[Material | Source]
_R = TypeVar("_R", bound=Report)


class Accuracy(TypedDict, total=False):
    """The scenes, or an accuracy that decides them."""

    near: int | None
    distant: int | None
    seed: int | None
    sampler: Literal["random", "sobol"] | None
    scenes: Scenes | None
    target_error: float | None


class Asked:
    """Opened materials, and the arguments of a function of the core."""

    def __init__(
        self,
        ground_truth: Material | Source,
        predictions: Predictions,
        question: Any,
        convention: str = "printed",
        precision: Precision = "f32",
        register: str | None = None,
        mask: ArrayLike | None = None,
    ) -> None:
        """`question`: options by name; None is left open."""
        asked = question_json(**question)
        given = listed(predictions)
        materials = [opened(one, precision) for one in (ground_truth, *given)]
        numbers = [f" {i}" for i in range(1, len(given) + 1)] if len(given) > 1 else [""]
        words = ["ground truth", *(f"prediction{number}" for number in numbers)]
        self.core = {
            "materials": [material._core for material in materials],
            "names": distinct(materials, words),
            "paths": [material.path for material in materials],
            "convention": convention,
            "precision": precision,
            "question": asked,
            "register": register,
            "mask": None if mask is None else as_mask(mask, materials[0].size[::-1]),
        }
        """The first argument of the function."""

    def answer(self, kind: type[_R], analysis: str, doing: str, progress: bool | Progress) -> _R:
        """The report of an analysis; called by a function of the package."""
        with reported(doing, progress) as report:
            found = _core.analysis(self.core, analysis, report)
        arrays = {} if found["maps"] is None else {"maps": tuple(found["maps"])}
        return report_of(kind, found["views"], stacklevel=4, **arrays)


def question_json(scenes: Scenes | None = None, **options: Any) -> str:
    """The options of a question that are specified, as JSON for the core, which checks them."""
    given: dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    if "texels" in given:
        given["texels"] = str(given["texels"])
    if isinstance(scenes, str | os.PathLike):
        given["scenes"] = os.fspath(scenes)
    elif scenes is not None:
        given["file"] = {"scenes": [Scene(*scene)._asdict() for scene in scenes]}
    return json.dumps(given, allow_nan=False, default=_plain)


def _plain(number: Any) -> Any:
    """A sequence, or a number of numpy."""
    if isinstance(number, Sequence):
        return list(number)
    return operator.index(number) if hasattr(number, "__index__") else float(number)


def listed(predictions: Predictions) -> Sequence[Material | Source]:
    """One material or several as a list.

    Raises:
        ValueError: There is none.
    """
    if isinstance(predictions, Material | str | os.PathLike):
        return [predictions]
    if not predictions:
        raise ValueError("predictions: expected at least one, found none; give a material, a path or a list of them")
    return predictions


def distinct(materials: Sequence[Material], words: Sequence[str]) -> list[str]:
    """The names of materials, or the words for those that have none, told apart by their paths."""
    named = [
        (material.name if material._is_named else word, material.path or "")
        for material, word in zip(materials, words, strict=True)
    ]
    return _core.distinct_names(named)

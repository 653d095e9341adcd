"""The arguments that the comparisons have in common."""

import json
import math
import numbers
import operator
import os
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from . import _core
from ._arrays import Precision
from ._material import Material, Source, opened
from ._progress import Report as Progress
from ._progress import reported
from ._report import Report, report_of
from ._scenes import Scene, check_whole, read_scenes

Scenes = Sequence[Scene] | Source
Predictions = Material | Source | Sequence[Material | Source]
_R = TypeVar("_R", bound=Report)


class Asked:
    """Opened materials, and the arguments of a function of the core."""

    def __init__(
        self,
        ground_truth: Material | Source,
        predictions: Predictions,
        *,
        convention: str,
        precision: Precision = "f32",
        alone: bool = False,
        **options: Any,
    ) -> None:
        """`alone`: a ground truth without predictions is enough. `options`: of the question; None is left open."""
        asked = question(**options)
        self.ground_truth = opened(ground_truth, precision)
        is_none = alone and isinstance(predictions, tuple | list) and not predictions
        given = () if is_none else listed(predictions, "predictions")
        self.predictions = [opened(prediction, precision) for prediction in given]
        materials = [self.ground_truth, *self.predictions]
        self._options = {
            "names": names(self.ground_truth, self.predictions),
            "paths": [material.path for material in materials],
            "convention": convention,
            "precision": precision,
            "question": asked,
        }

    @property
    def core(self) -> tuple[_core.CoreMaterial, list[_core.CoreMaterial], dict[str, Any]]:
        """The first arguments of the function."""
        return self.ground_truth._core, [prediction._core for prediction in self.predictions], self._options


def question(scenes: Scenes | None = None, **options: Any) -> str:
    """The options of a question that are specified, as JSON for the core.

    Raises:
        TypeError, ValueError: One has a wrong type or makes no sense.
    """
    given = {name: value for name, value in options.items() if value is not None}
    for name in {"near", "distant", "seed"}.intersection(given):
        check_whole(name, given[name])
        given[name] = operator.index(given[name])
    check_goals(**given)
    for name in {"target_error", "time_budget"}.intersection(given):
        given[name] = float(given[name])
    if scenes is not None:
        listed = read_scenes(scenes) if isinstance(scenes, str | os.PathLike) else scenes
        given["file"] = {"scenes": [_scene(*scene) for scene in listed]}
    return json.dumps(given)


def _scene(kind: str, view: Sequence[float], light: Sequence[float]) -> dict[str, Any]:
    ends = [[float(x) for x in end] for end in (view, light)]
    if not all(math.isfinite(x) for end in ends for x in end):
        raise ValueError(f"scenes: expected finite numbers, found view {view} and light {light}")
    return {"kind": kind, "view": ends[0], "light": ends[1]}


def answered(
    kind: type[_R], ask: "Callable[..., _core.Views]", asked: Asked, doing: str, progress: bool | Progress, *more: Any
) -> _R:
    """A report of the core: called by a function of the package.

    Args:
        kind: The type of the report.
        ask: The function of the core.
        asked: Its first arguments.
        doing: The title of the bar of the progress.
        progress: What the function of the package was given.
        more: Further arguments of the function of the core.
    """
    with reported(doing, progress) as report:
        found = ask(*asked.core, *more, report)
    return report_of(kind, found, stacklevel=4)


def repeated(repeats: Predictions | Sequence[Material | Source]) -> list[_core.CoreMaterial]:
    """Further captures of a ground truth, opened."""
    materials = [repeats] if isinstance(repeats, Material | str | os.PathLike) else repeats
    return [opened(material, "f32")._core for material in materials]


def listed(materials: Predictions, argument: str) -> Sequence[Material | Source]:
    """One material or several as a list.

    Raises:
        ValueError: There is none.
    """
    if isinstance(materials, Material | str | os.PathLike):
        return [materials]
    if not materials:
        raise ValueError(f"{argument}: expected at least one, found none; give a material, a path or a list of them")
    return materials


def names(ground_truth: Material, predictions: Sequence[Material]) -> list[str]:
    """Names of the materials in reports, which tell them apart."""
    return distinct([ground_truth, *predictions], ["ground truth", *numbered("prediction", len(predictions))])


def numbered(word: str, count: int) -> list[str]:
    """A word for each of several things, which has a number where there is more than one."""
    return [f"{word} {i}" for i in range(1, count + 1)] if count > 1 else [word] * count


def distinct(materials: Sequence[Material], words: Sequence[str]) -> list[str]:
    """The names of materials, or the words for those that have none, told apart by their paths."""
    named = [
        (material.name if material._is_named else word, material.path or "")
        for material, word in zip(materials, words, strict=True)
    ]
    return _core.distinct_names(named)


def check_goals(**given: object) -> None:
    """Whether the arguments that decide the scenes make sense.

    Raises:
        TypeError: One is no number.
        ValueError: One is out of its range.
    """
    named = [name for name, value in given.items() if value is not None]
    for name in {"target_error", "time_budget"}.intersection(named):
        if isinstance(given[name], bool) or not isinstance(given[name], numbers.Real):
            raise TypeError(f"{name}: expected a number, such as 0.01, found {given[name]!r}")
    target_error, time_budget = given.get("target_error"), given.get("time_budget")
    if isinstance(target_error, int | float) and not 0 < target_error < 1:
        raise ValueError(f"target_error: expected a number above 0, such as 0.01, found {target_error}")
    check_share("target_error", target_error)
    if isinstance(time_budget, int | float) and not 0 < time_budget <= 86_400:
        raise ValueError(f"time_budget: expected seconds above 0, at most a day, found {time_budget}")


def check_share(name: str, value: object) -> None:
    """Whether a target error is a share and not percent.

    Raises:
        ValueError: It could be either.
    """
    if isinstance(value, int | float) and 0.1 < value < 1:
        raise ValueError(
            f"{name}: expected a share of at most 0.1, such as 0.01 for 1%, found {value}, which is {value:.0%};"
            f" for {value}% give {value / 100:g}"
        )


def check_unused(deciding: str | None, **given: object) -> None:
    """Whether none of the arguments is given that do not apply beside the one that decides the scenes.

    Raises:
        ValueError: One is given.
    """
    unused = [name for name, value in given.items() if value is not None]
    if deciding is not None and unused:
        raise ValueError(
            f"{' and '.join(unused)}: not used with {deciding}, which decides the scenes; leave out either"
        )

"""The analyses that each have one question.

Generated from `svbrdf schema` by `cargo xtask bless types`: do not edit.
"""
# ruff: noqa: E501
# fmt: off

import json
from typing import Literal

from . import _core
from ._asked import Asked, Predictions, Scenes, answered
from ._material import Material, Source
from ._progress import Report as Progress
from ._reports import BlameReport, ScenesReport, WorstReport
from ._scenes import check_whole

__all__ = ["blame", "scenes", "worst"]


def blame(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    target_error: float | None = None,
    seed: int | None = None,
    scenes: Scenes | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> BlameReport:
    """Computes how much of the rendering loss comes from each map.

    Renders all 16 mixtures of the maps of the ground truth and of the prediction in the same scenes on the same
    texels. The Shapley value of a map is the mean of what it adds to the loss over all orders in which the maps can
    become wrong; the four values add up to the loss. Beside them stands the loss where only this map is wrong, and
    where only this map is right. A negative share: its error partly cancels the errors of others.

    The other args and errors are those of `svbrdf.loss`.
    """
    options = json.dumps({})
    asked = Asked(ground_truth, predictions, convention=convention, target_error=target_error, seed=seed, scenes=scenes)
    return answered(BlameReport, _core.analysis, asked, "rendering", progress, "blame", options)


def scenes(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    top: int = 10,
    near: int | None = None,
    distant: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    seed: int | None = None,
    scenes: Scenes | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> ScenesReport:
    """Computes the scenes with the largest losses, worst first.

    Scenes are sorted by the mean of the losses of all predictions in them, over all texels. The JSON is a scene
    file, too.

    `top`: number of scenes that are listed. The other args and errors are those of `svbrdf.loss`.
    """
    check_whole("top", top)
    options = json.dumps({"top": top})
    asked = Asked(ground_truth, predictions, convention=convention, near=near, distant=distant, sampler=sampler, seed=seed, scenes=scenes)
    return answered(ScenesReport, _core.analysis, asked, "rendering", progress, "scenes", options)


def worst(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    distance_tail: float = 0.005,
    seed: int | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> WorstReport:
    """Searches for the scene with the largest loss of each prediction.

    Evaluates 12,288 of the scenes that the loss is over, and distant ones with grazing light and view, on 1,024
    texels. Refines the worst of them, the best 4 on all texels. Distances have no largest value: the search is
    within the central 99% of their distributions, which the distance tail changes. The mean is the loss over all
    scenes, to +-1% where 49,152 scenes are enough. The JSON is a scene file, too.

    `distance_tail`: leaves out this share of the nearest distances, and as much of the farthest. The other args and
    errors are those of `svbrdf.loss`.
    """
    options = json.dumps({"distance_tail": distance_tail})
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed)
    return answered(WorstReport, _core.analysis, asked, "searching", progress, "worst", options)

"""Metrics beside the loss."""

import json
import math
from collections.abc import Sequence
from typing import Literal

from . import _core
from ._asked import Asked, Predictions, Scenes, answered
from ._material import Material, Source
from ._progress import Report as Progress
from ._reports import MetricsReport


def metrics(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    scenes: Scenes | None = None,
    convention: str | None = None,
    exposure: float | None = None,
    metrics: Sequence[str] = (),
    progress: bool | Progress = False,
) -> MetricsReport:
    """Metrics of maps and renderings: root mean square and mean absolute differences, angles, PSNR, SSIM and FLIP.

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> report = svbrdf.metrics(ground_truth, blurred, near=2, distant=1)
    >>> report.results[0].metrics["rmse_roughness"]
    0.0

    `metrics` are words of the names of those to compute, such as "psnr" or "rmse_roughness"; all where not given.
    `exposure` is that of the renderings in stops, before they are clipped, 0 where not given. Scenes are those of
    `svbrdf.scenes`, the other args and errors those of `svbrdf.loss`.
    """
    if exposure is not None and not math.isfinite(exposure):
        raise ValueError(f"exposure: expected a finite number of stops, found {exposure}")
    asked = Asked(ground_truth, predictions, convention=convention or "printed", near=near, distant=distant, seed=seed, sampler=sampler, scenes=scenes)
    options = json.dumps({"exposure": exposure or 0.0, "metrics": list(metrics)})
    return answered(MetricsReport, _core.analysis, asked, "rendering", progress, "metrics", options)

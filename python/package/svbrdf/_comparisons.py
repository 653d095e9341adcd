"""The rendering loss (Algorithm 1) with rankings by it, its causes, and metrics beside it."""

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np
from numpy.typing import NDArray

from . import _core, _reports
from ._arrays import Precision
from ._asked import Accuracy, Asked, Predictions, Question, Sampled, check_unused
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import pandas, report_of
from ._reports import DiagnoseReport, LossReport, MetricsReport, RankReport

if TYPE_CHECKING:
    import pandas as pd


def loss(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    convention: str = "printed",
    precision: Precision = "f32",
    progress: bool | Progress = False,
    **question: Unpack[Question],
) -> LossReport:
    """The rendering loss of predictions against a ground truth of the same size.

    Where neither `near` nor `distant` nor another argument decides the scenes, the answer is that of the command line:
    the loss over all scenes to +-1% and, beside it as `few_scenes_loss`, the loss over the 6 + 3 random scenes of the
    papers.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> report = svbrdf.loss(ground_truth, predictions)
    >>> [f"{result.loss:.3f}, over few scenes {result.few_scenes_loss:.3f}" for result in report.results]
    ['0.322, over few scenes 0.371', '0.205, over few scenes 0.220']
    >>> few = svbrdf.loss(ground_truth, predictions, near=6, distant=3, seed=1)
    >>> [f"{result.loss:.4f}" for result in few.results]
    ['0.2900', '0.1994']

    All cores work on it, without the lock of the interpreter, and Ctrl+C ends it. The result does not depend on the
    number of cores.

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials or paths.
        convention: A name of `svbrdf.CONVENTIONS`.
        precision: "f32", or "f64" for reference, which is many times slower.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).
        **question: The scenes.
            `target_error`: as many as this relative error needs at 95% confidence, as a share of at most 0.1: 0.01 is
            1%. `time_budget`: as many as fit into this time, in seconds. `near`, `distant`: the numbers of sampled
            near-field and distant scenes; two to one where only one is given. `scenes`: these, or those of a file.
            `seed` names the sampled scenes, 0 where not given. `sampler`: "random", or "sobol", which gives less error
            with as many scenes. `texels`: "all", or the number of random texels that are compared in each scene. With
            `near` or `distant` these are "random" and "all" by default, else "sobol" and 128: an accuracy has no other.

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, the sizes differ, or an option has no such value or is not
            used.
        TypeError, ValueError: Another argument has a wrong type or makes no sense.
    """
    asked = Asked(ground_truth, predictions, question, convention, precision)
    return asked.answer(LossReport, _core.loss, "rendering", progress)


def rank(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    convention: str = "printed",
    progress: bool | Progress = False,
    **question: Unpack[Accuracy],
) -> RankReport:
    """The predictions of one ground truth, smallest loss first, with what the data can separate.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> [(place.prediction, place.group) for place in svbrdf.rank(ground_truth, predictions).ranking]
    [('wrong roughness', 1), ('blurred normals', 2)]

    Args and errors are those of `svbrdf.loss`. Where nothing decides the scenes, `target_error` is 0.01. At most
    786,432 / (predictions + 1) scenes are sampled.
    """
    asked = Asked(ground_truth, predictions, question, convention)
    return asked.answer(RankReport, _core.rank, "rendering", progress)


def diagnose(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    seed: int = 0,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> DiagnoseReport:
    """Whether an exposure, a shift, a symmetry or another reading of the files explains a loss.

    >>> import svbrdf
    >>> ground_truth, _, _ = svbrdf.built_in()
    >>> maps = {name: getattr(ground_truth, name) for name in ("diffuse", "specular", "roughness")}
    >>> flipped = svbrdf.Material(normal=ground_truth.normal * [1, -1, 1], **maps)
    >>> svbrdf.diagnose(ground_truth, flipped).predictions[0].findings[4].marked
    True

    The other args and errors are those of `svbrdf.loss`.
    """
    asked = Asked(ground_truth, predictions, {"seed": seed}, convention)
    return asked.answer(DiagnoseReport, _core.diagnose, "diagnosing", progress)


def metrics(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    convention: str = "printed",
    exposure: float = 0.0,
    metrics: Sequence[str] = (),
    progress: bool | Progress = False,
    **sampled: Unpack[Sampled],
) -> MetricsReport:
    """Metrics of maps and renderings: root mean square and mean absolute differences, angles, PSNR, SSIM and FLIP.

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> report = svbrdf.metrics(ground_truth, blurred, near=2, distant=1)
    >>> report.results[0].metrics["rmse_roughness"]
    0.0

    `metrics` are words of the names of those to compute, such as "psnr" or "rmse_roughness"; all where not given.
    `exposure` is that of the renderings in stops, before they are clipped. Scenes are those of `svbrdf.scenes`, the
    other args and errors those of `svbrdf.loss`. `svbrdf metrics` has the protocols of publications.
    """
    asked = Asked(ground_truth, predictions, sampled, convention)
    own = json.dumps({"exposure": exposure, "metrics": list(metrics)}, allow_nan=False)
    return asked.answer(MetricsReport, _core.analysis, "rendering", progress, "metrics", own)


class MapReport(_reports.MapReport):
    """The loss over texels, or over the directions of the light or the view."""

    maps: tuple[NDArray[Any], ...]
    """One per prediction. Over texels: height x width x 3. Over directions: side x side, NaN outside of the disk."""
    standard_errors: tuple[NDArray[Any], ...] | None
    """Over directions: side x side for each prediction, due to the choice of texels."""
    directions: NDArray[Any] | None
    """Over directions: side x side x 3, NaN outside of the disk."""

    def to_pandas(self) -> "pd.DataFrame":
        """The command line's CSV as a data frame of pandas: a row for each texel or direction of each prediction.

        Raises:
            ImportError: pandas is not installed.
        """
        if self.directions is None or self.standard_errors is None:
            columns = ["column", "row", "red", "green", "blue"]
            rows, places = np.indices(self.maps[0].shape[:2])
            parts = [[places, rows, *np.moveaxis(values, -1, 0)] for values in self.maps]
        else:
            columns = ["x", "y", "z", "loss", "standard_error"]
            inside = ~np.isnan(self.directions[..., 0])
            pairs = zip(self.maps, self.standard_errors, strict=True)
            parts = [[*self.directions[inside].T, values[inside], errors[inside]] for values, errors in pairs]
        names = np.repeat([result.prediction for result in self.results], np.size(parts[0][0]))
        cells = (np.concatenate([np.ravel(part[i]) for part in parts]) for i in range(len(columns)))
        return pandas().DataFrame({"prediction": names.astype(object), **dict(zip(columns, cells, strict=True))})


def map(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    over: Literal["texels", "lights", "views"] = "texels",
    fixed: tuple[float, float, float] | None = None,
    side: int | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
    **sampled: Unpack[Sampled],
) -> MapReport:
    """The loss over texels, light directions or view directions, as arrays.

    Over texels: the mean log difference of each texel over all scenes, whose mean is the loss. Over lights or views:
    the loss in distant scenes over the directions that Algorithm 2 samples, seen from above (x to the right, y up).

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> svbrdf.map(ground_truth, blurred, near=4, distant=2).maps[0].shape
    (256, 256, 3)
    >>> svbrdf.map(ground_truth, blurred, over="lights", side=16).maps[0].shape
    (16, 16)

    `over` names the axes of the map. A map over lights or views has `side` columns and rows, from 1 to 1024, 64 where
    not given, and `fixed` is the direction of its view or light, (0, 0, 1) where not given. The scenes of a map over
    texels are those of `svbrdf.scenes`. The other args and errors are those of `svbrdf.loss`.
    """
    axes: dict[str, Any] | None = None
    if over == "texels":
        check_unused("over='texels'", fixed=fixed, side=side)
    else:
        check_unused(f"over={over!r}", **sampled)
        axes = {"over": over, "fixed": fixed or (0.0, 0.0, 1.0), "side": 64 if side is None else side}
    asked = Asked(ground_truth, predictions, sampled, convention)
    with reported("rendering", progress) as report:
        found = _core.map(asked.core, axes, report)
    errors, directions = found["of_directions"] or (None, None)
    return report_of(
        MapReport,
        found["views"],
        maps=tuple(found["maps"]),
        standard_errors=None if errors is None else tuple(errors),
        directions=directions,
    )

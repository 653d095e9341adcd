"""The directions, texels and trivial errors that a loss comes from."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _core, _reports
from ._arrays import from_bytes
from ._asked import Asked, Predictions, Scenes, answered, check_unused, repeated
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import data_frame, report_of
from ._reports import DiagnoseReport

if TYPE_CHECKING:
    import pandas as pd


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
        names = [result.prediction for result in self.results]
        if self.directions is None or self.standard_errors is None:
            places = [np.indices(values.shape[:2])[::-1].reshape(2, -1) for values in self.maps]
            columns, numbers = ["column", "row"], ["red", "green", "blue"]
            cells = [values.reshape(-1, 3).T for values in self.maps]
        else:
            inside = ~np.isnan(self.directions[..., 0])
            places = [self.directions[inside].T for _ in self.maps]
            columns, numbers = ["x", "y", "z"], ["loss", "standard_error"]
            pairs = zip(self.maps, self.standard_errors, strict=True)
            cells = [np.stack([values[inside], errors[inside]]) for values, errors in pairs]
        counts = [place.shape[1] for place in places]
        frame = data_frame(["prediction"], np.repeat(np.array(names, dtype=object), counts)[:, None])
        for column, values in zip(columns, np.concatenate(places, axis=1), strict=True):
            frame[column] = values
        for column, values in zip(numbers, np.concatenate(cells, axis=1), strict=True):
            frame[column] = values
        return frame


def diagnose(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    seed: int = 0,
    repeats: Material | Source | Sequence[Material | Source] = (),
    convention: str = "printed",
    progress: bool | Progress = False,
) -> DiagnoseReport:
    """Whether an exposure, a shift, a symmetry or another reading of the files explains a loss.

    >>> import svbrdf
    >>> ground_truth, _, _ = svbrdf.built_in()
    >>> maps = {name: getattr(ground_truth, name) for name in ("diffuse", "specular", "roughness")}
    >>> flipped = svbrdf.Material(normal=ground_truth.normal * [1, -1, 1], **maps)
    >>> svbrdf.diagnose(ground_truth, flipped).predictions[0].findings[6].marked
    True

    `repeats` are other captures of the ground truth: the floor is the mean loss between all captures in place of the
    loss that rounding leaves. The other args and errors are those of `svbrdf.loss`.
    """
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed)
    return answered(DiagnoseReport, _core.diagnose, asked, "diagnosing", progress, repeated(repeats))


def map(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    over: Literal["texels", "lights", "views"] = "texels",
    fixed: tuple[float, float, float] | None = None,
    side: int | None = None,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    scenes: Scenes | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
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
    choice: dict[str, Any] = {"near": near, "distant": distant, "seed": seed, "sampler": sampler, "scenes": scenes}
    if over == "texels":
        check_unused("over='texels'", fixed=fixed, side=side)
        axes = None
    else:
        check_unused(f"over={over!r}", **choice)
        side = 64 if side is None else side
        if not 1 <= side <= 1024:
            raise ValueError(f"side: expected 1 to 1024, found {side}")
        axes = {"over": over, "fixed": tuple(fixed or (0.0, 0.0, 1.0)), "side": side}
    asked = Asked(ground_truth, predictions, convention=convention, **choice)
    with reported("rendering", progress) as report:
        found = _core.map(*asked.core, axes, report)
    directions, errors = found["directions"], found["standard_errors"]
    if directions is None or side is None:
        maps = tuple(from_bytes(data, asked.ground_truth.size, 3, "f32") for data in found["maps"])
        return report_of(MapReport, found["views"], maps=maps, standard_errors=None, directions=None)
    size = (side, side)
    return report_of(
        MapReport,
        found["views"],
        maps=tuple(from_bytes(data, size, 1, "f64") for data in found["maps"]),
        standard_errors=tuple(from_bytes(data, size, 1, "f64") for data in errors),
        directions=from_bytes(directions, size, 3, "f64"),
    )

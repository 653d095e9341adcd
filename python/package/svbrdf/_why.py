"""The scenes, directions and texels that a loss comes from."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import from_bytes
from ._asked import Asked, Predictions, Scenes, answered, check_unused
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import Report, data_frame, pair, views
from ._scenes import Scene, check_whole, scenes_from

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Worst:
    """The worst scene of a prediction."""

    prediction: str
    worst: float
    """The loss in that scene."""
    mean: float
    """The loss over all scenes."""
    interval95: tuple[float, float] | None
    """The 95% confidence interval of the mean."""
    target_error: float
    """The requested accuracy of the mean."""
    target_reached: bool
    evaluations: int
    """The number of scenes that the search rendered."""


@dataclass(frozen=True, repr=False, kw_only=True)
class WorstReport(Report):
    """The scene with the largest loss of each prediction."""

    ground_truth: str
    convention: str
    epsilon: float
    distance_tail: float
    """The share of the nearest distances, and of the farthest ones, that the search leaves out."""
    results: tuple[Worst, ...]
    """One per prediction."""
    scenes: tuple[Scene, ...]
    """The worst scene of each prediction."""


@dataclass(frozen=True)
class ScenesLoss:
    """The loss of a prediction in single scenes."""

    prediction: str
    loss: float
    """Over all scenes."""
    losses: tuple[float, ...]
    """The loss of each listed scene."""


@dataclass(frozen=True, repr=False, kw_only=True)
class ScenesReport(Report):
    """The scenes with the largest losses, worst first."""

    ground_truth: str
    convention: str
    epsilon: float
    seed: int | None
    """None where the scenes were given."""
    of: int
    """The number of scenes that these are the worst of."""
    results: tuple[ScenesLoss, ...]
    """One per prediction."""
    scenes: tuple[Scene, ...]


@dataclass(frozen=True)
class MapSummary:
    """The map of a prediction in a few numbers."""

    prediction: str
    mean: float
    """The loss."""
    largest: float
    column: int | None = None
    """Where a map over texels is largest."""
    row: int | None = None
    direction: tuple[float, float, float] | None = None
    """Where a map over directions is largest."""
    standard_error: float | None = None
    """The root mean square of the standard errors of a map over directions."""


@dataclass(frozen=True, repr=False, kw_only=True)
class MapReport(Report):
    """The loss over texels, or over the directions of the light or the view."""

    ground_truth: str
    convention: str
    epsilon: float
    shows: str
    """The meaning of the numbers."""
    results: tuple[MapSummary, ...]
    """One per prediction."""
    maps: tuple[NDArray[Any], ...] = field(compare=False)
    """One per prediction. Over texels: height x width x 3. Over directions: side x side, NaN outside of the disk."""
    standard_errors: tuple[NDArray[Any], ...] | None = field(compare=False)
    """Over directions: side x side for each prediction, due to the choice of texels."""
    directions: NDArray[Any] | None = field(compare=False)
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


def worst(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    seed: int = 0,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> WorstReport:
    """Searches for the scene with the largest loss of each prediction.

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> report = svbrdf.worst(ground_truth, blurred)
    >>> report.results[0].worst > 3 * report.results[0].mean
    True

    12,288 of the scenes that the loss is over are sampled, and the 16 worst refined, the best two on all texels.
    Distances are within the central 99% of their distributions. The loss of the scene that it finds is over all texels.

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        seed: Names the scenes that the search starts from.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material cannot be used, or the sizes differ.
    """
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed)
    arguments, values = answered(_core.worst, asked, "searching", progress)
    results = tuple(Worst(**{**entry, "interval95": pair(entry["interval95"])}) for entry in values["results"])
    return WorstReport(**arguments, **{**values, "results": results, "scenes": scenes_from(values["scenes"])})


def scenes(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    top: int = 10,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    scenes: Scenes | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> ScenesReport:
    """The scenes with the largest losses, sorted by the mean of the losses of all predictions in them, worst first.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> report = svbrdf.scenes(ground_truth, predictions, top=3)
    >>> len(report.scenes), report.of
    (3, 192)

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        top: The number of scenes that are listed.
        near: The number of sampled near-field scenes; two for each distant one where only `distant` is
            given, else 128.
        distant: The number of sampled distant scenes; one for two near-field ones where only `near` is
            given, else 64.
        seed: Names the sampled scenes; 0 where `scenes` are not given.
        sampler: "sobol", the default, or "random".
        scenes: These scenes, or those of a scene file, in place of sampled ones.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, or the sizes differ.
        ValueError: Options of sampled scenes are given together with `scenes`.
    """
    choice = scene_choice(near=near, distant=distant, seed=seed, sampler=sampler, scenes=scenes)
    asked = Asked(ground_truth, predictions, convention=convention, **choice)
    check_whole("top", top)
    arguments, values = answered(_core.scenes, asked, "rendering", progress, top)
    results = tuple(ScenesLoss(**{**entry, "losses": tuple(entry["losses"])}) for entry in values["results"])
    return ScenesReport(**arguments, **{**values, "results": results, "scenes": scenes_from(values["scenes"])})


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

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        over: The axes of the map.
        fixed: The direction of the view of a map over lights, or of the light of a map over views; (0, 0, 1) there.
        side: Columns and rows of a map over lights or views, from 1 to 1024; 64 there.
        near: The number of sampled near-field scenes of a map over texels; two for each distant one where only
            `distant` is given, else 128.
        distant: The number of sampled distant scenes of a map over texels; one for two near-field ones where only
            `near` is given, else 64.
        seed: Names the sampled scenes of a map over texels; 0 where `scenes` are not given.
        sampler: "sobol", the default, or "random".
        scenes: These scenes, or those of a scene file, in place of sampled ones.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, or the sizes differ.
        ValueError: `side` is out of its range, or an argument is not used with others.
    """
    if over == "texels":
        check_unused("over='texels'", fixed=fixed, side=side)
        choice = scene_choice(near=near, distant=distant, seed=seed, sampler=sampler, scenes=scenes)
        axes = None
    else:
        check_unused(f"over={over!r}", near=near, distant=distant, seed=seed, sampler=sampler, scenes=scenes)
        choice = {}
        side = 64 if side is None else side
        if not 1 <= side <= 1024:
            raise ValueError(f"side: expected 1 to 1024, found {side}")
        axes = {"over": over, "fixed": tuple(fixed or (0.0, 0.0, 1.0)), "side": side}
    asked = Asked(ground_truth, predictions, convention=convention, **choice)
    with reported("rendering", progress) as report:
        found = _core.map(*asked.core, axes, report)
    arguments = views(found["views"])
    values = arguments["_values"]
    fields = {**values, "results": tuple(_map_summary(entry) for entry in values["results"])}
    directions, errors = found["directions"], found["standard_errors"]
    if directions is None or side is None:
        maps = tuple(from_bytes(data, asked.ground_truth.size, 3, "f32") for data in found["maps"])
        return MapReport(**arguments, **fields, maps=maps, standard_errors=None, directions=None)
    size = (side, side)
    return MapReport(
        **arguments,
        **fields,
        maps=tuple(from_bytes(data, size, 1, "f64") for data in found["maps"]),
        standard_errors=tuple(from_bytes(data, size, 1, "f64") for data in errors),
        directions=from_bytes(directions, size, 3, "f64"),
    )


def _map_summary(entry: dict[str, Any]) -> MapSummary:
    direction = entry.get("direction")
    return MapSummary(**{**entry, "direction": None if direction is None else tuple(direction)})


def scene_choice(*, scenes: Scenes | None, **sampling: Any) -> dict[str, Any]:
    """The listed scenes, or the 128 + 64 sampled ones with what is given in place of the defaults.

    Raises:
        ValueError: Both are given.
    """
    if scenes is not None:
        check_unused("scenes", **sampling)
        return {"scenes": scenes}
    near, distant = _core.scene_counts(sampling.get("near"), sampling.get("distant"), (128, 64))
    given = {name: value for name, value in sampling.items() if value is not None}
    return {"seed": 0, "sampler": "sobol", **given, "near": near, "distant": distant}

"""Methods over a data set of materials."""

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from . import _core
from ._asked import check_goals
from ._material import Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import Report, pair, views
from ._scenes import check_whole


@dataclass(frozen=True)
class MetricSummary:
    """A metric of the maps of a method over the materials."""

    mean: float | None
    """Of a PSNR, that of the mean square error; None where it is infinite: the maps of all materials are equal."""
    median: float | None
    interval95_materials: tuple[float, float] | None
    """The 95% interval of the mean over all materials like these; None for fewer than 5, and for an infinite mean."""


@dataclass(frozen=True)
class MarkSummary:
    """The marks of a method over the materials that were diagnosed."""

    materials: int
    """The number of materials with a diagnosis."""
    marked: int
    """The number of these with any mark."""
    by: Mapping[str, int]
    """The number of materials that are marked by each hypothesis."""
    not_resolvable: int
    """The number of materials whose loss is not above the floor of the ground truth."""
    to_best_not_resolvable: int | None
    """The number of materials whose difference to the best method is not above it; None for the best."""


@dataclass(frozen=True)
class DoubtCount:
    """The number of materials whose reading is in doubt, by what."""

    doubt: str
    """Such as "without normal map" or "with unsure specular"."""
    materials: int


@dataclass(frozen=True)
class ReadingSummary:
    """How the materials of a method, or the ground truths, were read."""

    materials: int
    """The number of materials that were read."""
    doubts: tuple[DoubtCount, ...]
    """The most frequent first."""


@dataclass(frozen=True)
class MethodSummary:
    """The losses of a method."""

    method: str
    compared: bool
    """Whether it has a loss of as many materials as any other; if not, its mean is over other materials."""
    materials: int
    """The number of materials with a loss."""
    failures: int
    """The number of materials without one."""
    mean: float | None
    """Over the materials that all compared methods have, `compared_materials`; None without a loss."""
    median: float | None
    interval95_materials: tuple[float, float] | None
    """The 95% interval of the mean over all materials like these; None for fewer than 5."""
    interval95_scenes: tuple[float, float]
    """The 95% interval of the mean over these materials, due to the sampling of scenes alone."""
    to_best: float | None
    """The mean difference to the best method over the materials of both; None for the best."""
    to_best_interval95_materials: tuple[float, float] | None
    ties_with_best: bool
    """Whether it is compared, and the materials cannot separate it from the best."""
    reading: ReadingSummary | None
    """How its predictions were read; None where there are none."""
    metrics: Mapping[str, MetricSummary]
    """Of the maps by name; empty where they were not asked for."""
    marks: MarkSummary | None
    """None where no diagnosis was asked for."""


@dataclass(frozen=True)
class DatasetLoss:
    """The loss of one prediction of a data set."""

    material: str
    method: str
    sample: int
    """Which of the predictions of the method for this material, from 0."""
    path: str
    seed: int
    """Names the scenes of this material."""
    scenes: int | None
    """Their number, as many as the accuracy of this loss took; None without a loss."""
    loss: float | None
    """None where `error` says why."""
    standard_error: float | None
    interval95: tuple[float, float] | None
    error: str | None
    metrics: Mapping[str, float | None]
    """Of the maps by name, None for the infinite PSNR of equal maps; empty where they were not asked for or the maps
    cannot be compared."""
    reading: tuple[str, ...]
    """What was noticed and assumed in reading the prediction."""
    ground_truth_reading: tuple[str, ...]
    """The same for the ground truth."""
    floor: float | None
    """The loss that the ground truth cannot resolve; None where no diagnosis was asked for."""
    marks: tuple[Mapping[str, Any], ...] | None
    """The marked findings, the largest share first: `hypothesis`, `value`, `share`, `remedy`; None where not asked
    for."""


@dataclass(frozen=True, repr=False, kw_only=True)
class DatasetReport(Report):
    """The losses of methods over a data set."""

    convention: str
    target_error: float
    seed: int
    pick: str
    command: str
    """The command that makes the results again."""
    compared_materials: tuple[str, ...]
    """The materials that the means of compared methods are over."""
    ground_truths: ReadingSummary
    """How the ground truths were read."""
    methods: tuple[MethodSummary, ...]
    """Those that are compared, smallest mean loss first; then those that lack materials."""
    results: tuple[DatasetLoss, ...]
    """Every prediction, in the order of the materials."""

    def _shown(self) -> tuple[Sequence[str], Sequence[Sequence[Any]]]:
        """A row for each method: there may be thousands of predictions."""
        columns = ["method", "compared", "materials", "failures", "mean", "median", "to_best", "ties_with_best"]
        low, high = "95% over materials, low", "95% over materials, high"
        rows = [
            [*(getattr(method, column) for column in columns), *(method.interval95_materials or (None, None))]
            for method in self.methods
        ]
        return [*columns, low, high], rows


def rank_dataset(
    ground_truths: Source,
    methods: Source | Sequence[Source] | Mapping[str, Source],
    *,
    target_error: float = 0.01,
    seed: int = 0,
    convention: str = "printed",
    pick: Literal["fixed", "mean", "best"] = "fixed",
    strict: bool = False,
    metrics: bool = False,
    diagnose: bool = False,
    results: Source | None = None,
    read_ground_truth: Mapping[str, Any] | None = None,
    read_predictions: Mapping[str, Any] | None = None,
    read_methods: Mapping[str, Mapping[str, Any]] | None = None,
    progress: bool | Progress = False,
) -> DatasetReport:
    """Compares methods over a data set: `svbrdf rank --dataset`, with the same numbers.

    Materials of the same name in the folders belong together. `name_0`, `name_1` and so on in the folder of a method
    are several predictions of one material. A file that cannot be read is a result with its error, and not fatal.
    Materials are compared in parallel.

    Args:
        ground_truths: The folder of the ground truths.
        methods: The folder of each method, or folders by the name of the method. A path with `{}` is a pattern, in
            which `{}` stands for the name of a material: "out/{}_pred.png".
        target_error: As many scenes for each material as this relative error of every loss needs at 95% confidence.
        seed: Names the sampled scenes, together with the name of the material.
        convention: A name of `svbrdf.CONVENTIONS`.
        pick: Which of several predictions counts: the first, the mean of their losses, or the best.
        strict: Whether guesses in reading are errors.
        metrics: Whether to compute metrics of the maps, too: RMSE, L1, angles and SSIM. docs/metrics.md defines them.
        diagnose: Whether to mark what an error of exposure, alignment or reading explains of each loss, as
            `svbrdf.diagnose` does, and the losses that the ground truth does not resolve.
        results: A folder of losses: those that are in it are used, and the others are added as they come. It is the
            folder of `svbrdf rank --dataset --results`.
        read_ground_truth: Options of `svbrdf.read` for the ground truths, such as `{"albedo": "srgb"}`.
        read_predictions: The same for the predictions.
        read_methods: The same for the predictions of some methods, by name: `{"ours": {"normal_y": "down"}}`. They
            replace those of `read_predictions`.
        progress: True for a bar of tqdm, or a function of (materials done, materials in all).

    Warns:
        UserWarning: Files were read on an assumption that is in doubt: one warning for each method, and one for the
            ground truths. `DatasetReport.results` has every assumption. A file of `results` is damaged.

    Raises:
        OSError: A folder cannot be read, or the folder of results cannot be written.
        svbrdf.Error: A folder has no materials, or an option has no such value.
    """
    check_goals(target_error=target_error)
    check_whole("seed", seed)
    asked = {
        "ground_truths": ground_truths,
        "methods": _named(methods),
        "target_error": target_error,
        "seed": seed,
        "convention": convention,
        "pick": pick,
        "strict": strict,
        "metrics": metrics,
        "diagnose": diagnose,
        "results": results,
        "read": [_options(given) for given in (read_ground_truth, read_predictions)],
        "read_methods": {name: _options(given) for name, given in (read_methods or {}).items()},
    }
    with reported("comparing materials", progress) as report:
        found = _core.rank_dataset(asked, report)
    arguments = views(found)
    values = arguments["_values"]
    settings = values["settings"]
    return DatasetReport(
        **arguments,
        convention=settings["convention"],
        target_error=settings["target_error"],
        seed=settings["seed"],
        pick=values["pick"],
        command=values["command"],
        compared_materials=tuple(values["compared_materials"]),
        ground_truths=_reading(values["ground_truths"]),
        methods=tuple(_summary(entry) for entry in values["methods"]),
        results=tuple(_result(result, entry) for result in values["results"] for entry in result["predictions"]),
    )


def _reading(entry: dict[str, Any]) -> ReadingSummary:
    return ReadingSummary(entry["materials"], tuple(DoubtCount(**doubt) for doubt in entry["doubts"]))


def _summary(entry: dict[str, Any]) -> MethodSummary:
    intervals = ("interval95_materials", "interval95_scenes", "to_best_interval95_materials")
    metrics = {
        name: MetricSummary(**{**metric, "interval95_materials": pair(metric["interval95_materials"])})
        for name, metric in entry.get("metrics", {}).items()
    }
    marks = None if entry.get("marks") is None else MarkSummary(**entry["marks"])
    reading = None if entry["reading"] is None else _reading(entry["reading"])
    pairs = {name: pair(entry[name]) for name in intervals}
    return MethodSummary(**{**entry, **pairs, "metrics": metrics, "marks": marks, "reading": reading})


def _result(result: dict[str, Any], entry: dict[str, Any]) -> DatasetLoss:
    known = entry["result"].get("Ok", {"loss": None, "standard_error": None, "interval95": None, "scenes": None})
    return DatasetLoss(
        material=result["material"],
        method=entry["method"],
        sample=entry["sample"],
        path=entry["path"],
        seed=result["seed"],
        scenes=known["scenes"],
        loss=known["loss"],
        standard_error=known["standard_error"],
        interval95=pair(known["interval95"]),
        error=entry["result"].get("Err"),
        metrics=entry.get("metrics", {}),
        reading=tuple(remark["text"] for remark in entry["reading"]),
        ground_truth_reading=tuple(remark["text"] for remark in result["reading"]),
        floor=result.get("floor"),
        marks=None if entry.get("marks") is None else tuple(entry["marks"]),
    )


def _named(methods: Source | Sequence[Source] | Mapping[str, Source]) -> list[tuple[str, str]]:
    if isinstance(methods, Mapping):
        named = [(name, os.fspath(folder)) for name, folder in methods.items()]
    else:
        folders = [methods] if isinstance(methods, str | os.PathLike) else list(methods)
        paths = [os.fspath(folder) for folder in folders]
        names = _core.distinct_names([(Path(path).name or path, path) for path in paths])
        named = list(zip(names, paths, strict=True))
    if not named:
        raise ValueError("methods: expected at least one folder, found none")
    return named


def _options(given: Mapping[str, Any] | None) -> str:
    return json.dumps({name.replace("_", "-"): value for name, value in (given or {}).items()})

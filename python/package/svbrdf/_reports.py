"""The types of reports: the keys of their JSON.

Generated from `svbrdf schema` by `cargo xtask bless types`: do not edit.
"""
# ruff: noqa: E501
# fmt: off

from collections.abc import Mapping
from typing import Any, Literal

from ._report import Record, Report
from ._scenes import Scene

__all__ = [
    "AskedQuestion",
    "Attribution",
    "BlameReport",
    "Change",
    "ConformReport",
    "DatasetReport",
    "DiagnoseReport",
    "Diagnosis",
    "Difference",
    "DoubtCount",
    "Estimate",
    "FewScenes",
    "Finding",
    "Loss",
    "LossReport",
    "MapShare",
    "MapSummary",
    "Mark",
    "MarkSummary",
    "MaterialReading",
    "MaterialResult",
    "MethodSummary",
    "MetricSummary",
    "Metrics",
    "MetricsReport",
    "PhotoMeasure",
    "PhotoReport",
    "PhotoResult",
    "PredictionResult",
    "RankReport",
    "RankedPrediction",
    "ReadPhotograph",
    "ReadingSummary",
    "Remark",
    "Repetition",
    "RobustReport",
    "ScenesLoss",
    "ScenesReport",
    "TermDifference",
    "Worst",
    "WorstReport",
]


class Estimate(Record):
    """A mean over scenes and how far it may be from the mean over all scenes there are."""

    mean: float
    """The mean over the scenes."""
    standard_error: float | None
    """Standard error of `mean`; None (unknown) where a stratum has one independent unit."""
    interval95: tuple[float, float] | None
    """The 95% confidence interval of the mean over all scenes; None where the standard error is."""


class MapShare(Record):
    """What a map adds to a loss. Estimates have the unit of the loss; their errors are due to the sampling of scenes and texels."""

    map: Literal["normal", "diffuse", "specular", "roughness"]
    shapley: Estimate
    """The Shapley value."""
    only_wrong: Estimate
    """The loss where only this map is wrong: the others are the maps of the ground truth."""
    only_right: Estimate
    """The loss where only this map is right: the others are the maps of the prediction."""


class Attribution(Record):
    """The loss of a prediction and the part of each map."""

    prediction: str
    scenes: int
    """The number of scenes."""
    seed: int | None
    """None where the scenes were listed."""
    target_reached: bool | None
    """Whether the loss is known as well as requested; None where no accuracy was."""
    loss: Estimate
    """The sum of the Shapley values."""
    maps: tuple[MapShare, ...]


class BlameReport(Report):
    """The attribution of the loss of each prediction to its maps."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    target_error: float | None
    """The requested accuracy of each loss: half of its 95% interval, as a share of it."""
    attributions: tuple[Attribution, ...]
    """One per prediction."""


class TermDifference(Record):
    """A term in which a renderer differs from a convention."""

    term: str
    """Its key in the TOML of a convention."""
    found: str
    expected: str
    gap: float | None
    """Largest relative change of a radiance where this term alone is that of the convention; None where it is not one of radiance."""


class ConformReport(Report):
    """Whether a renderer conforms to a convention, and in which terms it differs."""

    verdict: Literal["conforms", "differs", "unknown"]
    """`conforms`, `differs`, or `unknown`: it is no member of the grammar of conventions, or cannot be told."""
    convention: str
    """The convention that it is compared with."""
    same_as: tuple[str, ...]
    """The named conventions that render as it does."""
    renderer: Mapping[str, Mapping[str, bool | float | str | tuple[float, ...]]] | None
    """The renderer; None where the verdict is unknown."""
    nearest: Mapping[str, Mapping[str, bool | float | str | tuple[float, ...]]] | None
    """The member of the grammar that is nearest, which is not the renderer; None where the renderer is known."""
    differences: tuple[TermDifference, ...]
    """From the convention; of the nearest member where the verdict is unknown."""
    residual: float
    """Root mean square of what remains, relative to the radiances."""
    storage: str
    """How precisely the radiances are stored."""
    points: int
    """The number of points."""


class DoubtCount(Record):
    """The number of materials with one doubt."""

    doubt: str
    """What is in doubt, such as "without normal map"."""
    materials: int


class ReadingSummary(Record):
    """How the materials of a method, or the ground truths, were read."""

    materials: int
    """The number of materials that were read."""
    doubts: tuple[DoubtCount, ...]
    """For each doubt the number of materials that have it, the most frequent first."""


class MarkSummary(Record):
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


class MetricSummary(Record):
    """A metric of a method over the materials that its mean loss is over."""

    mean: float | None
    """The mean; of a PSNR, that of the mean square error, which is infinite only where the maps of all materials are equal."""
    median: float | None
    interval95_materials: tuple[float, float] | None
    """The 95% interval of the mean over all materials like these; None for fewer than 5, and where the mean is infinite."""


class MethodSummary(Record):
    """The losses of a method."""

    method: str
    compared: bool
    """Whether it has a loss of as many materials as any other; if not, its mean is over other materials."""
    materials: int
    """The number of materials with a loss."""
    failures: int
    """The number of materials without one."""
    mean: float | None
    """Over the materials that all compared methods have, `compared_materials`; of a method that is not compared, over those that it has a loss of; None without a loss."""
    median: float | None
    """Over the materials of the mean."""
    interval95_materials: tuple[float, float] | None
    """The 95% interval of the mean over all materials like these; None for fewer than 5."""
    interval95_scenes: tuple[float | None, float | None]
    """The 95% interval of the mean over these materials, due to the sampling of scenes alone."""
    to_best: float | None
    """The mean difference to the best method over the materials of both; None for the best, and where nothing is compared."""
    to_best_interval95_materials: tuple[float, float] | None
    ties_with_best: bool
    """Whether it is compared, and the materials cannot separate it from the best: tables set it in bold."""
    reading: ReadingSummary | None
    """How its predictions were read; None where there are none."""
    marks: MarkSummary | None
    """None where no diagnosis was asked for."""
    metrics: Mapping[str, MetricSummary] | None
    """Of the maps, by name; None where they were not asked for."""


class Repetition(Record):
    """How to repeat a result."""

    software: str
    """The program and its version."""
    command: str
    """The command line."""


class Mark(Record):
    """A marked finding of a diagnosis."""

    hypothesis: str
    """Its name, such as "exposure"."""
    value: Any
    """A number, a list of numbers or a name."""
    share: float
    """The part of the loss that disappears under the hypothesis."""
    remedy: str | None
    """The options that correct the reading, as `--read` has them after the name of the method: `normal-y=down`; after that of the ground truths where `hypothesis` is "ground_truth"."""


class Remark(Record):
    """One thing that was noticed or assumed in reading a material."""

    text: str
    """The remark, as `info` prints it."""
    doubt: str | None
    """What the number of materials with remarks like it is of, such as "without normal map" or "unsure specular"; None for a remark on nothing that is in doubt."""


class PredictionResult(Record):
    """The result of one prediction."""

    method: str
    sample: int
    path: str
    reading: tuple[Remark, ...]
    """What was noticed and assumed in reading it."""
    error: str | None
    """Why there is no loss."""
    interval95: tuple[float, float] | None
    """The 95% confidence interval of the loss over all scenes."""
    loss: float | None
    """The loss."""
    marks: tuple[Mark, ...] | None
    """The marks of its diagnosis, the largest share first, where they were asked for."""
    metrics: Mapping[str, float | None] | None
    """The metrics of its maps by name, where they were asked for; the PSNR of equal maps is infinite, in JSON None."""
    scenes: int | None
    """The number of scenes that its accuracy took: the first ones of the seed of its material, so that it does not depend on which other predictions there are."""
    standard_error: float | None
    """Due to the sampling of scenes and texels."""


class MaterialResult(Record):
    """The results of one material."""

    index: int
    material: str
    seed: int
    """The seed of its scenes: errors due to scenes are independent between materials."""
    reading: tuple[Remark, ...]
    """What was noticed and assumed in reading the ground truth."""
    predictions: tuple[PredictionResult, ...]
    floor: float | None
    """The loss that the ground truth cannot resolve, where diagnoses were asked for."""


class DatasetReport(Report):
    """The losses of methods over a data set."""

    settings: Mapping[str, Any]
    reading: Mapping[str, Any]
    """How the files are read."""
    pick: Literal["fixed", "mean", "best"]
    """Which of several predictions of a material counts."""
    repetition: Repetition
    """How to repeat it."""
    compared_materials: tuple[str, ...]
    """The names of the materials that the means of compared methods are over."""
    ground_truths: ReadingSummary
    """How the ground truths were read."""
    methods: tuple[MethodSummary, ...]
    """The compared ones first, best first; then those that lack materials, the most materials first."""
    results: tuple[MaterialResult, ...]
    """One per material, in order."""


class Finding(Record):
    """The loss under a hypothesis, such as another exposure or another direction of y."""

    hypothesis: Literal["normal_y", "normal_x", "albedo_encoding", "diffuse_encoding", "specular_encoding", "roughness", "channels", "energy", "exposure", "exposure_rgb", "shift", "symmetry", "ground_truth"]
    value: float | tuple[float, float, float] | tuple[float, float] | str
    """The value with the least loss in the pilot."""
    unit: str | None
    loss: float
    """The loss under the hypothesis."""
    interval95: tuple[float, float] | None
    """The 95% confidence interval of this loss."""
    share: float
    """The part of the loss that disappears under the hypothesis, paired by scenes; negative where the loss grows."""
    share_interval95: tuple[float, float] | None
    """The 95% confidence interval of the share, from the paired differences."""
    p: float
    """The probability of such a fall where there is none, corrected for the number of hypotheses (Holm)."""
    marked: bool
    """Whether the loss falls significantly and by at least 10% beside the corrections of the other marked findings. Never where the loss is below the floor."""
    remedy: str | None
    """What `--read` takes to correct the reading: `name:normal-y=down`."""


class Diagnosis(Record):
    """What might explain the loss of a prediction."""

    prediction: str
    sentence: str
    """The finding in words."""
    loss: Estimate
    resolvable: bool
    """Whether the loss is above the floor."""
    explained: float | None
    """The part of the loss that disappears under all marked findings together; None without marks."""
    findings: tuple[Finding, ...]


class DiagnoseReport(Report):
    """The diagnosis of each prediction: docs/diagnose.md describes each line."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    seed: int
    floor: Estimate
    """The loss that the ground truth cannot resolve."""
    captures: int | None
    """The number of captures of the ground truth that the floor is the mean loss between; None: it is that of rounding."""
    predictions: tuple[Diagnosis, ...]
    """One per prediction."""


class Difference(Record):
    """The loss of a prediction - the loss of the first one, over the same scenes."""

    prediction: str
    to: str
    """The name of the first prediction."""
    difference: float
    standard_error: float | None
    interval95: tuple[float, float] | None


class FewScenes(Record):
    """The scenes of the losses over few scenes: another estimate of the loss, which depends on the seed."""

    near: int
    """The number of near-field scenes."""
    distant: int
    """The number of distant scenes."""
    seed: int | None
    """The seed that names the scenes; None where they were listed."""
    sampler: Literal["random", "sobol"] | None
    """None where the scenes were listed."""
    texels: int | Literal["all"]
    """The number of random texels in each scene, or "all"."""
    interval95_from: Literal["pilot", "scenes"]
    differences: tuple[Difference, ...]
    """One per prediction but the first, in these scenes."""
    scenes: tuple[Scene, ...]


class Loss(Record):
    """The loss of one prediction: the mean over scenes, texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|."""

    prediction: str
    path: str | None
    """Where it was read from."""
    loss: float
    standard_error: float | None
    """Due to the sampling of scenes and texels; None where a kind has a single scene."""
    interval95: tuple[float, float] | None
    """The 95% confidence interval of the loss over all scenes."""
    losses: tuple[float, ...] | None
    """The loss of each scene, in their order; None where an accuracy or a time decided how many there are."""
    few_scenes_interval95: tuple[float, float] | None
    few_scenes_loss: float | None
    """The loss over the 6 + 3 random scenes of the papers, beside a loss over all scenes."""
    few_scenes_losses: tuple[float, ...] | None
    """The loss of each of the few scenes, in their order."""
    few_scenes_standard_error: float | None


class LossReport(Report):
    """Losses with the settings that they depend on. Where the JSON lists scenes, it is a scene file, too, which `--scenes` takes."""

    ground_truth: str
    """The name of the ground truth."""
    ground_truth_path: str | None
    """Where it was read from."""
    convention: str
    """The name of the convention."""
    epsilon: float
    precision: str
    """`f32` or `f64`."""
    size: tuple[int, int]
    """Width and height in texels."""
    near: int
    """The number of near-field scenes."""
    distant: int
    """The number of distant scenes."""
    seed: int | None
    """The seed that names the scenes; None where they were listed."""
    sampler: Literal["random", "sobol"] | None
    """None where the scenes were listed."""
    texels: int | Literal["all"]
    """The number of random texels in each scene, or "all"."""
    interval95_from: Literal["pilot", "scenes"]
    """The source of all intervals."""
    target_error: float | None
    """The requested accuracy: half of the 95% interval, as a share of the loss."""
    target_reached: bool | None
    """Whether every loss has the requested accuracy; None where none was requested."""
    few_scenes: FewScenes | None
    """The scenes of `few_scenes_loss` of the results; None where an option chooses scenes."""
    results: tuple[Loss, ...]
    """One per prediction, in their order."""
    differences: tuple[Difference, ...]
    """One per prediction but the first."""
    scenes: tuple[Scene, ...] | None
    """None where a goal decides how many there are, which are far too many to read: their numbers, sampler, texels and seed ask for the same ones."""


class MapSummary(Record):
    """The map of a prediction in a few numbers."""

    prediction: str
    mean: float
    """The loss."""
    largest: float
    column: int | None
    """Where a map over texels is largest."""
    direction: tuple[float, float, float] | None
    """Where a map over directions is largest."""
    row: int | None
    standard_error: float | None
    """The root mean square of the standard errors of a map over directions."""


class MapReport(Report):
    """The loss over texels, or over the directions of the light or the view."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    shows: str
    """The meaning of the numbers."""
    results: tuple[MapSummary, ...]
    """One per prediction."""


class Metrics(Record):
    """The metrics of one prediction."""

    prediction: str
    metrics: Mapping[str, float | None]
    """By name; None for the infinite PSNR of equal maps or renderings."""
    intervals95: Mapping[str, tuple[float, float]]
    """The 95% intervals of means over sampled scenes by name, where they are known."""


class MetricsReport(Report):
    """Metrics of maps and renderings, each with its convention in its name: docs/metrics.md defines them."""

    ground_truth: str
    convention: str
    """The convention of the renderings."""
    exposure_ev: float
    """The exposure of the renderings in stops."""
    results: tuple[Metrics, ...]
    """One per prediction."""


class ReadPhotograph(Record):
    """How a photograph was read."""

    photograph: str
    """The name of its file in the capture, or the path of a single photograph."""
    size: tuple[int, int]
    """Width and height in pixels."""
    transfer: Literal["linear", "srgb", "gamma2.2"]


class PhotoMeasure(Record):
    """A material against one photograph; measures are None where all of it is clipped."""

    photograph: str
    """The name of the photograph."""
    log: float | None
    """The mean log difference."""
    rmse: float | None
    """The root mean square difference of sRGB values."""
    ssim: float | None
    """The SSIM of sRGB values."""
    clipped: int
    """The number of texels that are left out."""


class PhotoResult(Record):
    """A material against all photographs; its measures are the means over photographs."""

    material: str
    """The name of the material."""
    size: tuple[int, int]
    """Width and height in texels."""
    factor: float
    """The factor on all photographs: the median of rendering / photograph."""
    exposure_ev: float
    """The factor in stops."""
    log: float | None
    rmse: float | None
    ssim: float | None
    clipped: float
    """The share of the texels that are left out."""
    photographs: tuple[PhotoMeasure, ...]
    """In the order of the capture."""


class PhotoReport(Report):
    """Materials against photographs. Its JSON is a scene file, too."""

    path: str
    """The path of the photograph, or of what lists several."""
    photographs: tuple[ReadPhotograph, ...]
    """In the order of the capture."""
    falloff: bool
    """Whether the falloff of the light is divided out of the photographs."""
    convention: str
    """The name of the convention."""
    epsilon: float
    results: tuple[PhotoResult, ...]
    """The smallest mean log difference first."""
    scenes: tuple[Scene, ...]
    """Of the photographs."""
    notes: tuple[str, ...]
    """What reading the photographs noticed."""


class RankedPrediction(Record):
    """A prediction in a ranking."""

    index: int
    """The index of the prediction in the order of the question."""
    prediction: str
    loss: Estimate
    to_best: Estimate | None
    """The loss - the loss of the best prediction, over the same scenes; None for the best."""
    group: int
    """From 1. Predictions of one group are not separated from its first at 95% confidence."""
    resolvable: bool | None
    """Whether the loss is above the floor; None without a floor."""
    to_best_resolvable: bool | None
    """Whether the difference to the best is above the floor."""


class MaterialReading(Record):
    """How a material was read."""

    material: str
    remarks: tuple[str, ...]


class RankReport(Report):
    """Predictions of one ground truth, smallest loss first, with what the data can separate."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    scenes: int
    """The number of scenes."""
    seed: int | None
    target_error: float | None
    """The requested accuracy of every loss: half of its 95% interval, as a share of it; None for given scenes."""
    target_reached: bool | None
    """By every prediction."""
    floor: float | None
    """The loss that the ground truth cannot resolve; None: the depth of its files is not known here."""
    captures: int | None
    """The number of captures that the floor is the mean loss between; None: it is that of rounding."""
    ranking: tuple[RankedPrediction, ...]
    """Best first."""
    readings: tuple[MaterialReading, ...] | None
    """For each material, the ground truth first, what was noticed and assumed in reading it; None for materials of no files."""
    repetition: Repetition | None
    """How to repeat it; None for materials that no command names."""


class Change(Record):
    """A pair of predictions that changes sides."""

    question: str
    first: str
    second: str
    default_interval95: tuple[float, float]
    """95% interval of the score of the first - that of the second, by default."""
    interval95: tuple[float, float]
    """The same under the question."""


class AskedQuestion(Record):
    """A question, and the order that it gives."""

    question: str
    tau: float
    """Kendall's tau to the order by default: 1 where no pair changes sides."""
    order: tuple[str, ...]
    """The predictions, the best first."""


class RobustReport(Report):
    """Whether the order of predictions survives other conventions, epsilons and scenes."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    materials: tuple[str, ...]
    """The materials that scores are means over, with paired intervals over them; none where one ground truth is asked about."""
    sentence: str
    """The answer in a sentence."""
    questions: tuple[AskedQuestion, ...]
    """The default one first."""
    changes: tuple[Change, ...]
    """Pairs of predictions that change sides, where both differences are significant."""


class ScenesLoss(Record):
    """The loss of a prediction in single scenes."""

    prediction: str
    loss: float
    """Over all scenes."""
    losses: tuple[float, ...]
    """The loss of each listed scene."""


class ScenesReport(Report):
    """The scenes with the largest losses, sorted by the mean of the losses of all predictions in them, worst first. Its JSON is a scene file, too."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    seed: int | None
    """None where the scenes were listed."""
    of: int
    """The number of scenes that these are the worst of."""
    results: tuple[ScenesLoss, ...]
    """One per prediction."""
    scenes: tuple[Scene, ...]


class Worst(Record):
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


class WorstReport(Report):
    """The scene with the largest loss of each prediction. Its JSON is a scene file, too."""

    ground_truth: str
    convention: str
    """The name of the convention."""
    epsilon: float
    distance_tail: float
    """The share of the nearest distances, and of the farthest ones, that the search leaves out."""
    results: tuple[Worst, ...]
    """One per prediction."""
    scenes: tuple[Scene, ...]
    """The worst scene of each prediction."""

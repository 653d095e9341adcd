"""The rendering loss (Algorithm 1), and rankings by it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from . import _core
from ._arrays import Precision
from ._asked import Asked, Predictions, Scenes, check_goals, check_unused, repeated
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import Estimate, Report, estimate, pair, views
from ._scenes import Scene, scenes_from


@dataclass(frozen=True)
class Loss:
    """The loss of one prediction.

    The mean over scenes, texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|.
    """

    prediction: str
    """The name of the prediction."""
    path: str | None
    """Where it was read from."""
    loss: float
    standard_error: float | None
    """Due to the sampling of scenes and texels; None where a kind has a single scene."""
    interval95: tuple[float, float] | None
    """The 95% confidence interval of the loss over all scenes."""
    losses: tuple[float, ...] | None
    """The loss of each scene; None where an accuracy or a time decided how many there are."""
    few_scenes_loss: float | None = None
    """The loss over the 6 + 3 random scenes of the papers, beside a loss over all scenes."""
    few_scenes_standard_error: float | None = None
    few_scenes_interval95: tuple[float, float] | None = None
    few_scenes_losses: tuple[float, ...] | None = None
    """The loss of each of the few scenes."""


@dataclass(frozen=True)
class Difference:
    """The loss of a prediction minus that of the first prediction, in the same scenes."""

    prediction: str
    to: str
    """The name of the first prediction."""
    difference: float
    standard_error: float | None
    interval95: tuple[float, float] | None


@dataclass(frozen=True)
class FewScenes:
    """The scenes of the losses over few scenes."""

    near: int
    distant: int
    seed: int | None
    sampler: str | None
    texels: int | Literal["all"]
    backend: str
    interval95_from: str
    differences: tuple[Difference, ...]
    """One per prediction but the first, in these scenes."""
    scenes: tuple[Scene, ...]


@dataclass(frozen=True, repr=False, kw_only=True)
class LossReport(Report):
    """Losses with the settings that they depend on."""

    ground_truth: str
    ground_truth_path: str | None
    convention: str
    epsilon: float
    precision: str
    backend: str
    size: tuple[int, int]
    """(width, height) in texels."""
    near: int
    """The number of near-field scenes."""
    distant: int
    """The number of distant scenes."""
    seed: int | None
    """None where the scenes were given."""
    sampler: str | None
    texels: int | Literal["all"]
    """The number of random texels in each scene."""
    interval95_from: str
    """The source of the intervals: "pilot", many other scenes, or "scenes", those of the losses."""
    target_error: float | None
    """The requested accuracy: half of the 95% interval, as a share of the loss."""
    target_reached: bool | None
    few_scenes: FewScenes | None
    """The scenes of the `few_scenes_loss` of the results; None where an argument chooses the scenes."""
    results: tuple[Loss, ...]
    """One per prediction, in their order."""
    differences: tuple[Difference, ...]
    """One per prediction but the first."""
    scenes: tuple[Scene, ...] | None
    """None where an accuracy or a time decided how many there are: `svbrdf.sample_scenes` gives them."""

    @property
    def loss(self) -> float:
        """The loss of the first prediction."""
        return self.results[0].loss


@dataclass(frozen=True)
class RankedPrediction:
    """A prediction in a ranking."""

    index: int
    """Its index among the given predictions."""
    prediction: str
    """Its name."""
    loss: Estimate
    to_best: Estimate | None
    """Its loss minus that of the best prediction, in the same scenes; None for the best."""
    group: int
    """From 1. Predictions of one group are not separated from its first at 95% confidence."""
    resolvable: bool | None
    """Whether the loss is above the floor; None without a floor."""
    to_best_resolvable: bool | None
    """Whether the difference to the best is above the floor."""


@dataclass(frozen=True, repr=False, kw_only=True)
class RankReport(Report):
    """Predictions of one ground truth, smallest loss first."""

    ground_truth: str
    convention: str
    epsilon: float
    scenes: int
    """The number of scenes."""
    seed: int
    target_error: float
    """The requested accuracy of every loss: half of its 95% interval, as a share of it."""
    target_reached: bool
    floor: float | None
    """The loss that the ground truth cannot resolve; None: the depth of its files is not known here."""
    captures: int | None
    """The number of captures that the floor is the mean loss between; None: it is that of rounding."""
    ranking: tuple[RankedPrediction, ...]


def loss(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    target_error: float | None = None,
    time_budget: float | None = None,
    near: int | None = None,
    distant: int | None = None,
    seed: int = 0,
    sampler: Literal["random", "sobol"] | None = None,
    texels: int | Literal["all"] | None = None,
    convention: str = "printed",
    scenes: Scenes | None = None,
    precision: Precision = "f32",
    progress: bool | Progress = False,
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
        target_error: As many scenes as this relative error needs at 95% confidence, as a share of at most 0.1: 0.01 is
            1%.
        time_budget: As many scenes as fit into this time, in seconds.
        near: The number of sampled near-field scenes; two for each distant one where only `distant` is given.
        distant: The number of sampled distant scenes; one for two near-field ones where only `near` is given.
        seed: Names the sampled scenes.
        sampler: "random", or "sobol", which gives less error with as many scenes. The default is "random" with `near`
            or `distant`, else "sobol": an accuracy has no other.
        texels: "all", or the number of random texels that are compared in each scene. The default is "all" with `near`
            or `distant`, else 128: an accuracy has no other.
        convention: A name of `svbrdf.CONVENTIONS`.
        scenes: These scenes, or those of a scene file, in place of sampled ones.
        precision: "f32", or "f64" for reference, which is many times slower.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, the sizes differ, or an option has no such value.
        TypeError, ValueError: An argument has a wrong type, a number that makes no sense, or is not used.
    """
    goals = {"target_error": target_error, "time_budget": time_budget, "scenes": scenes}
    check_goals(**goals)
    deciding = next((name for name, value in goals.items() if value is not None), None)
    check_unused(deciding, near=near, distant=distant, sampler=sampler, texels=texels)
    asked = Asked(
        ground_truth,
        predictions,
        convention=convention,
        seed=seed,
        precision=precision,
        scenes=scenes,
        near=near,
        distant=distant,
        sampler=sampler,
        texels=None if texels is None else str(texels),
        target_error=target_error,
        time_budget=time_budget,
    )
    with reported("rendering", progress) as report:
        found = _core.loss(*asked.core, report)
    return _loss_report(views(found))


def rank(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    target_error: float = 0.01,
    seed: int = 0,
    repeats: Material | Source | Sequence[Material | Source] = (),
    convention: str = "printed",
    progress: bool | Progress = False,
) -> RankReport:
    """The predictions of one ground truth, smallest loss first, with what the data can separate.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> [(place.prediction, place.group) for place in svbrdf.rank(ground_truth, predictions).ranking]
    [('wrong roughness', 1), ('blurred normals', 2)]

    Args and errors are those of `svbrdf.loss`, `repeats` those of `svbrdf.diagnose`. At most 786,432 /
    (predictions + 1) scenes are sampled.
    """
    check_goals(target_error=target_error)
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed)
    with reported("rendering", progress) as report:
        found, order = _core.rank(*asked.core, target_error, repeated(repeats), report)
    arguments = views(found)
    values = arguments["_values"]
    ranking = [
        RankedPrediction(
            index=index,
            **{
                **entry,
                "loss": estimate(entry["loss"]),
                "to_best": None if entry["to_best"] is None else estimate(entry["to_best"]),
            },
        )
        for index, entry in zip(order, values["ranking"], strict=True)
    ]
    return RankReport(**arguments, **{**values, "ranking": tuple(ranking)})


def _loss_report(arguments: dict[str, Any]) -> LossReport:
    values = arguments["_values"]
    few = values["few_scenes"]
    if few is not None:
        few = FewScenes(
            **{**few, "differences": _differences(few["differences"]), "scenes": scenes_from(few["scenes"])}
        )
    fields = {
        **values,
        "size": tuple(values["size"]),
        "few_scenes": few,
        "results": tuple(_loss(entry) for entry in values["results"]),
        "differences": _differences(values["differences"]),
        "scenes": None if values["scenes"] is None else scenes_from(values["scenes"]),
    }
    return LossReport(**arguments, **fields)


def _loss(entry: dict[str, Any]) -> Loss:
    def numbers(name: str) -> tuple[float, ...] | None:
        return None if entry.get(name) is None else tuple(entry[name])

    arrays = ("losses", "interval95", "few_scenes_losses", "few_scenes_interval95")
    return Loss(**{**entry, **{name: numbers(name) for name in arrays}})


def _differences(entries: Sequence[dict[str, Any]]) -> tuple[Difference, ...]:
    return tuple(Difference(**{**entry, "interval95": pair(entry["interval95"])}) for entry in entries)

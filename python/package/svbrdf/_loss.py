"""The rendering loss (Algorithm 1)."""

import os
import warnings
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

from . import _core
from ._arrays import Precision
from ._material import Material, Source, opened
from ._progress import Report, reported
from ._scenes import Scene, read_scenes, scenes_of


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
class Place:
    """A prediction in a ranking."""

    index: int
    """The index of its result."""
    to_best: Difference | None
    """Its loss minus that of the best prediction, in the same scenes; None for the best."""
    group: int
    """From 1. Predictions of one group are not separated from its first at 95% confidence."""


@dataclass(frozen=True, repr=False)
class LossReport:
    """Losses with the settings that they depend on. The `repr` is the table of the command line."""

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
    """What the intervals come from: "pilot", many other scenes, or "scenes", those of the losses."""
    target_error: float | None
    target_reached: bool | None
    results: tuple[Loss, ...]
    """One per prediction, in their order."""
    differences: tuple[Difference, ...]
    """One per prediction but the first."""
    scenes: tuple[Scene, ...] | None
    """None where an accuracy or a time decided how many there are: `svbrdf.sample_scenes` gives them."""
    places: tuple[Place, ...]
    """The predictions, smallest loss first."""
    text: str
    """The table of the command line."""

    @property
    def loss(self) -> float:
        """The loss of the first prediction."""
        return self.results[0].loss

    def to_dict(self) -> dict[str, Any]:
        """The report as the command line's JSON has it: numbers, words, lists and dictionaries."""
        values = asdict(self)
        del values["text"], values["places"]
        if self.scenes is not None:
            values["scenes"] = [scene._asdict() for scene in self.scenes]
        return values

    def __repr__(self) -> str:
        return self.text.rstrip("\n")


def loss(
    ground_truth: Material | Source,
    predictions: Material | Source | Sequence[Material | Source],
    *,
    target_error: float | None = None,
    time_budget: float | None = None,
    near: int = 6,
    distant: int = 3,
    seed: int = 0,
    sampler: Literal["random", "sobol"] = "random",
    texels: int | Literal["all"] = "all",
    convention: str = "printed",
    scenes: Sequence[Scene] | Source | None = None,
    precision: Precision = "f32",
    progress: bool | Report = False,
) -> LossReport:
    """The rendering loss of predictions against a ground truth of the same size.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> report = svbrdf.loss(ground_truth, predictions, seed=1)
    >>> [f"{result.loss:.4f}" for result in report.results]
    ['0.2900', '0.1994']

    All cores work on it, without the lock of the interpreter, and Ctrl+C ends it. The result does not depend on the
    number of cores.

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials or paths.
        target_error: As many scenes as this relative error needs at 95% confidence, such as 0.01. `near`, `distant`,
            `sampler` and `texels` do not apply.
        time_budget: As many scenes as fit into this time, in seconds. The same do not apply.
        near: The number of sampled near-field scenes.
        distant: The number of sampled distant scenes.
        seed: Names the sampled scenes.
        sampler: "random", or "sobol", which gives less error with as many scenes.
        texels: "all", or the number of random texels that are compared in each scene.
        convention: A name of `svbrdf.CONVENTIONS`.
        scenes: These scenes, or those of a scene file, in place of sampled ones.
        precision: "f32", or "f64" for reference, which is many times slower.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, the sizes differ, or an option has no such value.
        TypeError, ValueError: An argument has a wrong type, or a number that makes no sense.
    """
    check_goals(target_error, time_budget, scenes)
    if isinstance(predictions, Material | str | os.PathLike):
        predictions = [predictions]
    if not predictions:
        raise ValueError("predictions: expected at least one, found none; give a material, a path or a list of them")
    gt = opened(ground_truth, precision)
    others = [opened(prediction, precision) for prediction in predictions]
    if isinstance(scenes, str | os.PathLike):
        scenes = read_scenes(scenes)
    asked = {
        "names": _names(gt, others),
        "near": near,
        "distant": distant,
        "seed": seed,
        "sampler": sampler,
        "texels": str(texels),
        "target_error": target_error,
        "time_budget": time_budget,
        "scenes": None if scenes is None else [tuple(scene) for scene in scenes],
        "convention": convention,
        "precision": precision,
    }
    with reported("rendering", progress) as report:
        items = _core.loss(gt._core, [other._core for other in others], asked, report)
    return _report(items, gt, others, target_error, lists_scenes=target_error is None and time_budget is None)


def rank(
    ground_truth: Material | Source,
    predictions: Sequence[Material | Source],
    *,
    target_error: float = 0.01,
    seed: int = 0,
    convention: str = "printed",
    progress: bool | Report = False,
) -> list[tuple[Loss, Place]]:
    """The predictions of one ground truth, smallest loss first, with what the data can separate.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> [(loss.prediction, place.group) for loss, place in svbrdf.rank(ground_truth, predictions)]
    [('wrong roughness', 1), ('blurred normals', 2)]

    Args and errors are those of `svbrdf.loss`.
    """
    report = loss(
        ground_truth, predictions, target_error=target_error, seed=seed, convention=convention, progress=progress
    )
    return [(report.results[place.index], place) for place in report.places]


def check_goals(target_error: float | None, time_budget: float | None, scenes: object) -> None:
    """Whether at most one goal decides the scenes, and makes sense."""
    given = {"target_error": target_error, "time_budget": time_budget, "scenes": scenes}
    named = [name for name, value in given.items() if value is not None]
    if len(named) > 1:
        raise ValueError(f"{' and '.join(named)}: expected one of them; each decides the scenes")
    if target_error is not None and not 0 < target_error < 1:
        raise ValueError(f"target_error: expected a number above 0 and below 1, such as 0.01, found {target_error}")
    if time_budget is not None and not 0 < time_budget <= 86_400:
        raise ValueError(f"time_budget: expected seconds above 0, at most a day, found {time_budget}")


def _names(ground_truth: Material, predictions: list[Material]) -> list[str]:
    """What the report calls them: names that tell them apart."""

    def name(material: Material, otherwise: str) -> str:
        return material.name if material._is_named else otherwise

    several = len(predictions) > 1
    words = [f"prediction {i}" if several else "prediction" for i in range(1, len(predictions) + 1)]
    named = [(name(ground_truth, "ground truth"), ground_truth.path or "")]
    named += [(name(p, word), p.path or "") for p, word in zip(predictions, words, strict=True)]
    return _core.distinct_names(named)


def _report(
    items: dict[str, Any],
    ground_truth: Material,
    predictions: list[Material],
    target_error: float | None,
    *,
    lists_scenes: bool,
) -> LossReport:
    relative_error = items.pop("relative_error95")
    reached = None if target_error is None else relative_error <= target_error
    results = []
    for result, prediction in zip(items.pop("results"), predictions, strict=True):
        losses = tuple(result.pop("losses")) if lists_scenes else None
        results.append(Loss(**{**result, "losses": losses}, path=prediction.path))
    listed = items.pop("scenes")
    scenes = tuple(scenes_of(listed)) if lists_scenes else None
    texels = items.pop("texels")
    places = [
        Place(index, None if to_best is None else Difference(**to_best), group)
        for index, to_best, group in items.pop("places")
    ]
    report = LossReport(
        **{**items, "differences": tuple(Difference(**values) for values in items["differences"])},
        ground_truth_path=ground_truth.path,
        texels="all" if texels == "all" else int(texels),
        target_error=target_error,
        target_reached=reached,
        results=tuple(results),
        places=tuple(places),
        scenes=scenes,
    )
    if reached is False:
        count = report.near + report.distant
        warnings.warn(
            f"the losses are known to +-{relative_error:.2%}, not to the target of +-{target_error:.2%}: "
            f"{count} scenes, the limit, are not enough; go by the interval, or set a larger target",
            stacklevel=3,
        )
    return report

"""How much of a loss comes from each map."""

from dataclasses import dataclass
from typing import Any

from . import _core
from ._asked import Asked, Predictions, Scenes, answered, check_goals
from ._material import Material, Source
from ._progress import Report as Progress
from ._report import Estimate, Report, estimate


@dataclass(frozen=True)
class MapShare:
    """The part of a loss that a map adds."""

    map: str
    """"normal", "diffuse", "specular" or "roughness"."""
    shapley: Estimate
    """The Shapley value: the mean of what it adds over all orders in which the maps can become wrong."""
    only_wrong: Estimate
    """The loss where only this map is wrong."""
    only_right: Estimate
    """The loss where only this map is right."""


@dataclass(frozen=True)
class Attribution:
    """The loss of a prediction and the part of each map."""

    prediction: str
    """The name of the prediction."""
    scenes: int
    """The number of scenes."""
    seed: int | None
    target_reached: bool | None
    loss: Estimate
    """The sum of the Shapley values."""
    maps: tuple[MapShare, ...]


@dataclass(frozen=True, repr=False, kw_only=True)
class BlameReport(Report):
    """The attribution of the loss of each prediction to its maps."""

    ground_truth: str
    convention: str
    epsilon: float
    target_error: float | None
    """The requested accuracy of each loss: half of its 95% interval, as a share of it."""
    attributions: tuple[Attribution, ...]
    """One per prediction."""

    @property
    def loss(self) -> Estimate:
        """The loss of the first prediction."""
        return self.attributions[0].loss

    @property
    def maps(self) -> tuple[MapShare, ...]:
        """The part of each map in the loss of the first prediction."""
        return self.attributions[0].maps


def blame(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    target_error: float | None = None,
    seed: int = 0,
    scenes: Scenes | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> BlameReport:
    """How much of the loss of each prediction comes from each of its maps: Shapley values, which add up to the loss.

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> report = svbrdf.blame(ground_truth, blurred, target_error=0.05)
    >>> max(report.maps, key=lambda share: share.shapley.mean).map
    'normal'

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        target_error: As many scenes as this relative error of the loss needs at 95% confidence, at most 49,152; 0.01
            where `scenes` are not given.
        seed: Names the sampled scenes.
        scenes: These scenes, or those of a scene file, in place of sampled ones.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, or the sizes differ.
        ValueError: `target_error` is no share, or given together with `scenes`.
    """
    check_goals(target_error=target_error, scenes=scenes)
    if scenes is None and target_error is None:
        target_error = 0.01
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed, scenes=scenes, target_error=target_error)
    arguments, values = answered(_core.blame, asked, "rendering", progress)
    attributions = tuple(_attribution(entry) for entry in values["attributions"])
    return BlameReport(**arguments, **{**values, "attributions": attributions})


def _attribution(entry: dict[str, Any]) -> Attribution:
    maps = tuple(_share(share) for share in entry["maps"])
    return Attribution(**{**entry, "loss": estimate(entry["loss"]), "maps": maps})


def _share(items: dict[str, Any]) -> MapShare:
    estimates = {key: estimate(items[key]) for key in ("shapley", "only_wrong", "only_right")}
    return MapShare(map=items["map"], **estimates)

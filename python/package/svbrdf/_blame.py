"""How much of a loss comes from each map."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from . import _core
from ._loss import check_goals
from ._material import Material, Source, opened
from ._progress import Report, reported
from ._scenes import Scene


@dataclass(frozen=True)
class Estimate:
    """A mean over scenes with its error."""

    mean: float
    standard_error: float | None
    interval95: tuple[float, float] | None


@dataclass(frozen=True)
class MapShare:
    """What a map adds to a loss."""

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
    """The loss of a prediction and what each map adds to it."""

    scenes: int
    """The number of scenes."""
    seed: int | None
    loss: Estimate
    """The sum of the Shapley values."""
    maps: tuple[MapShare, ...]


def blame(
    ground_truth: Material | Source,
    prediction: Material | Source,
    *,
    target_error: float = 0.01,
    seed: int = 0,
    scenes: Sequence[Scene] | None = None,
    convention: str = "printed",
    progress: bool | Report = False,
) -> Attribution:
    """How much of the loss of a prediction comes from each of its maps: Shapley values, which add up to the loss.

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> attribution = svbrdf.blame(ground_truth, blurred, target_error=0.05)
    >>> max(attribution.maps, key=lambda share: share.shapley.mean).map
    'normal'

    Args:
        ground_truth: A material, or the path of one.
        prediction: A material of the same size, or the path of one.
        target_error: As many scenes as this relative error of the loss needs at 95% confidence.
        seed: Names the sampled scenes.
        scenes: These scenes, in place of sampled ones.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, or the sizes differ.
    """
    check_goals(target_error, None, None)
    asked = {
        "names": [],
        "near": 0,
        "distant": 0,
        "seed": seed,
        "sampler": "sobol",
        "texels": "all",
        "target_error": target_error,
        "time_budget": None,
        "scenes": None if scenes is None else [tuple(scene) for scene in scenes],
        "convention": convention,
        "precision": "f32",
    }
    truth, other = opened(ground_truth), opened(prediction)
    with reported("rendering", progress) as report:
        items = _core.blame(truth._core, other._core, asked, report)
    loss = Estimate(**items.pop("loss"))
    return Attribution(**{**items, "loss": loss, "maps": tuple(_share(share) for share in items["maps"])})


def _share(items: dict[str, Any]) -> MapShare:
    estimates = {key: Estimate(**items[key]) for key in ("shapley", "only_wrong", "only_right")}
    return MapShare(map=items["map"], **estimates)

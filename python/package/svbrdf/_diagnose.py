"""Whether something trivial explains a loss."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from . import _core
from ._asked import Asked, Predictions, answered, repeated
from ._material import Material, Source
from ._progress import Report as Progress
from ._report import Estimate, Report, estimate


@dataclass(frozen=True)
class Finding:
    """The loss under a hypothesis, such as another exposure or another direction of y."""

    hypothesis: str
    """"exposure", "exposure_rgb", "shift", "subtexel", "symmetry", "resampling", "normal_y", "normal_x",
    "albedo_encoding", "diffuse_encoding", "specular_encoding", "roughness", "channels", "energy" or "ground_truth"."""
    value: float | str | list[float]
    """The value with the least loss in a pilot."""
    unit: str | None
    """"stops" or "texels"."""
    loss: float | None
    """The loss under the hypothesis, in other scenes than those of the pilot."""
    interval95: list[float] | None
    share: float | None
    """The part of the loss that disappears; negative where it grows."""
    share_interval95: list[float] | None
    p: float | None
    """The probability of such a fall where there is none, corrected for the number of hypotheses; None: not tested."""
    marked: bool
    """Whether the loss falls significantly and by at least 10% beside the corrections of the other marked findings;
    never where the loss is below the floor."""
    remedy: str | None
    """What `--read` of the command line takes to correct the reading: NAME:KEY=VALUE."""


@dataclass(frozen=True)
class Diagnosis:
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
    ladder: list[dict[str, Any]]
    """The loss between averages over blocks of `side` x `side` texels, and the filtered roughness of both materials."""
    seams: list[dict[str, Any]]
    """The rank of the difference across each wrap among those of all neighbours; small: a visible seam."""


@dataclass(frozen=True, repr=False, kw_only=True)
class DiagnoseReport(Report):
    """The diagnosis of each prediction: docs/diagnose.md describes each line."""

    ground_truth: str
    convention: str
    epsilon: float
    seed: int
    floor: Estimate
    """The loss that the ground truth cannot resolve."""
    captures: int | None
    """The number of captures that the floor is the mean loss between; None: it is that of rounding."""
    seams: list[dict[str, Any]]
    """Those of the ground truth."""
    predictions: tuple[Diagnosis, ...]
    """One per prediction."""


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

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        seed: Names the sampled scenes.
        repeats: Other captures of the ground truth: the floor is the mean loss between all captures in place of the
            loss that rounding leaves.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material cannot be used, or the sizes differ.
    """
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed)
    arguments, values = answered(_core.diagnose, asked, "diagnosing", progress, repeated(repeats))
    diagnoses = tuple(_diagnosis(entry) for entry in values["predictions"])
    return DiagnoseReport(**arguments, **{**values, "floor": estimate(values["floor"]), "predictions": diagnoses})


def _diagnosis(entry: dict[str, Any]) -> Diagnosis:
    findings = tuple(Finding(**finding) for finding in entry["findings"])
    return Diagnosis(**{**entry, "loss": estimate(entry["loss"]), "findings": findings})

"""The rendering loss (Algorithm 1), and rankings by it."""

from collections.abc import Sequence
from typing import Literal

from . import _core
from ._arrays import Precision
from ._asked import Asked, Predictions, Scenes, answered, repeated
from ._material import Material, Source
from ._progress import Report as Progress
from ._reports import LossReport, RankReport


def loss(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    target_error: float | None = None,
    time_budget: float | None = None,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
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
        seed: Names the sampled scenes; 0 where not given.
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
    return answered(LossReport, _core.loss, asked, "rendering", progress)


def rank(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    target_error: float | None = None,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    scenes: Scenes | None = None,
    repeats: Material | Source | Sequence[Material | Source] = (),
    convention: str = "printed",
    progress: bool | Progress = False,
) -> RankReport:
    """The predictions of one ground truth, smallest loss first, with what the data can separate.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> [(place.prediction, place.group) for place in svbrdf.rank(ground_truth, predictions).ranking]
    [('wrong roughness', 1), ('blurred normals', 2)]

    Args and errors are those of `svbrdf.loss`, `repeats` those of `svbrdf.diagnose`. Where nothing decides the scenes,
    `target_error` is 0.01. At most 786,432 / (predictions + 1) scenes are sampled.
    """
    asked = Asked(
        ground_truth,
        predictions,
        convention=convention,
        target_error=target_error,
        near=near,
        distant=distant,
        seed=seed,
        sampler=sampler,
        scenes=scenes,
    )
    return answered(RankReport, _core.rank, asked, "rendering", progress, repeated(repeats))

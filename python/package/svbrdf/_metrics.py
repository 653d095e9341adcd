"""Metrics beside the loss."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from . import _core
from ._asked import Asked, Predictions, Scenes, check_unused
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import Report, views
from ._why import scene_choice


@dataclass(frozen=True)
class Metrics:
    """The metrics of one prediction."""

    prediction: str
    metrics: Mapping[str, float | None]
    """By name; None for the infinite PSNR of equal maps or renderings."""
    intervals95: Mapping[str, tuple[float, float]]
    """The 95% intervals of means over sampled scenes by name, where they are known."""


@dataclass(frozen=True, repr=False, kw_only=True)
class MetricsReport(Report):
    """Metrics of maps and renderings, each with its convention in its name: docs/metrics.md defines them."""

    ground_truth: str
    convention: str | None = None
    """The convention of the renderings; None for those of a protocol."""
    exposure_ev: float | None = None
    """The exposure of the renderings in stops; None for those of a protocol."""
    protocol: str | None = None
    """The published evaluation."""
    results: tuple[Metrics, ...]
    """One per prediction."""


def metrics(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    scenes: Scenes | None = None,
    convention: str | None = None,
    exposure: float | None = None,
    protocol: Literal["matfusion"] | None = None,
    progress: bool | Progress = False,
) -> MetricsReport:
    """Metrics of maps and renderings: root mean square and mean absolute differences, angles, PSNR, SSIM and FLIP.

    With `protocol`, what the released code of a publication computes, without neural networks.

    >>> import svbrdf
    >>> ground_truth, blurred, _ = svbrdf.built_in()
    >>> report = svbrdf.metrics(ground_truth, blurred, near=2, distant=1)
    >>> report.results[0].metrics["rmse_roughness"]
    0.0

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        near: The number of sampled near-field scenes; two for each distant one where only `distant` is
            given, else 128.
        distant: The number of sampled distant scenes; one for two near-field ones where only `near` is
            given, else 64.
        seed: Names the sampled scenes; 0 where `scenes` are not given.
        sampler: "sobol", the default, or "random".
        scenes: These scenes, or those of a scene file, in place of sampled ones.
        convention: A name of `svbrdf.CONVENTIONS`; "printed" where no protocol is given.
        exposure: That of the renderings in stops, before they are clipped; 0 where no protocol is given.
        protocol: "matfusion": Sartor and Peers 2023, score.py. Takes files, since normals are compared as
            stored.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, or the sizes differ.
        ValueError: Options of sampled scenes are given together with `scenes`, or scenes, a convention, an exposure or
            a material of arrays with a protocol; or the exposure is no finite number.
    """
    if protocol is not None:
        if protocol != "matfusion":
            raise ValueError(f"protocol: expected 'matfusion', found {protocol!r}")
        check_unused(
            "protocol",
            near=near,
            distant=distant,
            seed=seed,
            sampler=sampler,
            scenes=scenes,
            convention=convention,
            exposure=exposure,
        )
        asked = Asked(ground_truth, predictions, convention="printed", precision="f64")
        with reported("rendering", progress) as report:
            return _of(_core.matfusion(*asked.core, asked.options, report))
    if exposure is not None and not math.isfinite(exposure):
        raise ValueError(f"exposure: expected a finite number of stops, found {exposure}")
    choice = scene_choice(near=near, distant=distant, seed=seed, sampler=sampler, scenes=scenes)
    asked = Asked(ground_truth, predictions, convention=convention or "printed", **choice)
    with reported("rendering", progress) as report:
        return _of(_core.metrics(*asked.core, exposure or 0.0, report))


def _of(found: "_core.Views") -> MetricsReport:
    """The report of its views."""
    arguments = views(found)
    values = arguments["_values"]
    results = tuple(
        Metrics(
            entry["prediction"],
            entry["metrics"],
            {name: (low, high) for name, (low, high) in entry.get("intervals95", {}).items()},
        )
        for entry in values["results"]
    )
    return MetricsReport(**arguments, **{**values, "results": results})

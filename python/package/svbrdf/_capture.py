"""Materials against the photographs of a capture."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from . import _core
from ._asked import Predictions, photographed
from ._material import Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import Estimate, Report, estimate, views
from ._scenes import Scene, scenes_from


@dataclass(frozen=True)
class CapturePhotograph:
    """How a photograph of a capture was read."""

    photograph: str
    """The name of its file in the capture."""
    size: tuple[int, int]
    """(width, height) in pixels."""
    transfer: str
    corners: tuple[tuple[float, float], ...]
    """Top left, top right, bottom right and bottom left of the material, in pixels."""
    held_out: bool
    """Whether the exposure of the capture is not fitted to it."""


@dataclass(frozen=True)
class CaptureOutlier:
    """In what a photograph differs from the others of its capture."""

    exposure: bool
    """The exposure that fits it alone: brighter or darker than the others."""
    difference: bool
    """Its log difference: larger than that of the others."""


@dataclass(frozen=True)
class CaptureMeasure:
    """A material against one photograph; None where all of it is clipped."""

    photograph: str
    factor: float | None
    """The photograph was multiplied by it."""
    exposure_ev: float | None
    """The factor in stops."""
    own_exposure_ev: float | None
    """The factor that fits this photograph alone, in stops."""
    log: float | None
    """The mean log difference."""
    rmse: float | None
    """The root mean square difference of sRGB values."""
    ssim: float | None
    """The SSIM of sRGB values."""
    texels: int
    clipped: int
    """The number of texels that are left out."""
    outlier: CaptureOutlier


@dataclass(frozen=True)
class CaptureMeans:
    """The means over a group of photographs, with their intervals over photographs."""

    photographs: Literal["all", "fitted", "held out"]
    count: int
    """The number of photographs."""
    log: Estimate | None
    rmse: Estimate | None
    ssim: Estimate | None


@dataclass(frozen=True)
class CaptureResult:
    """A material against all photographs."""

    material: str
    """The name of the material."""
    size: tuple[int, int]
    """(width, height) in texels."""
    factor: float | None
    """The factor on all photographs; None where each has its own."""
    exposure_ev: float | None
    """The factor in stops."""
    declared_ev: float | None
    """The stops by which it exceeds the factor that `light_pow` of MaterialGAN gives."""
    means: tuple[CaptureMeans, ...]
    photographs: tuple[CaptureMeasure, ...]


@dataclass(frozen=True, repr=False, kw_only=True)
class CaptureReport(Report):
    """Materials against the photographs of a capture, the smallest mean log difference first."""

    capture: str
    """Its path."""
    file: str
    """The file that lists the photographs."""
    photographs: tuple[CapturePhotograph, ...]
    falloff: bool
    """Whether the falloff of the light is divided out of the photographs."""
    exposure: Literal["capture", "photograph"]
    """What one factor is fitted to."""
    declared_factor: float | None
    """The factor that `light_pow` of MaterialGAN gives."""
    convention: str
    epsilon: float
    results: tuple[CaptureResult, ...]
    scenes: tuple[Scene, ...]
    """Of the photographs."""
    notes: tuple[str, ...]
    """What reading the photographs noticed."""


def capture(
    capture: Source,
    materials: Predictions,
    *,
    exposure: Literal["capture", "photograph"] = "capture",
    hold_out: Sequence[str] = (),
    transfer: Literal["linear", "srgb", "gamma2.2"] | None = None,
    clip: float | None = None,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> CaptureReport:
    """Compares renderings of materials with all photographs of a capture.

    Each material is rendered under the light and the view of each photograph (Algorithm 3).

    Args:
        capture: The folder of a capture, or the file that lists its photographs: capture.json, or the JSON file
            (render.json) or camera_pos.txt of MaterialGAN. docs/photographs.md describes them.
        materials: One or several materials or paths.
        exposure: Whether one factor brings all photographs to the exposure of the renderings, or one each of them.
        hold_out: Names of photographs to which the exposure is not fitted.
        transfer: The transfer curve of the photographs; without, by the capture, or else by the files.
        clip: The stored value from which on a pixel is clipped, where 1 is the largest integer; without, by the
            capture, or else 1, and none for floats.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: The capture, a photograph or a material cannot be used.
        ValueError: There is no material, or `clip` is not above 0.
    """
    asked = photographed(
        materials,
        transfer=transfer,
        clip=clip,
        capture=capture,
        exposure=exposure,
        hold_out=list(hold_out),
        convention=convention,
    )
    with reported("comparing", progress) as report:
        found = _core.capture(*asked, report)
    arguments = views(found["views"])
    values = arguments["_values"]
    fields = {
        **values,
        "photographs": tuple(_photograph(entry) for entry in values["photographs"]),
        "results": tuple(_result(entry) for entry in values["results"]),
        "scenes": scenes_from(values["scenes"]),
        "notes": tuple(found["notes"]),
    }
    return CaptureReport(**arguments, **fields)


def _photograph(entry: dict[str, Any]) -> CapturePhotograph:
    corners = tuple((x, y) for x, y in entry["corners"])
    return CapturePhotograph(**{**entry, "size": tuple(entry["size"]), "corners": corners})


def _result(entry: dict[str, Any]) -> CaptureResult:
    means = tuple(_means(group) for group in entry["means"])
    measures = tuple(_measure(one) for one in entry["photographs"])
    return CaptureResult(**{**entry, "size": tuple(entry["size"]), "means": means, "photographs": measures})


def _means(group: dict[str, Any]) -> CaptureMeans:
    measured = {key: None if group[key] is None else estimate(group[key]) for key in ("log", "rmse", "ssim")}
    return CaptureMeans(**{**group, **measured})


def _measure(one: dict[str, Any]) -> CaptureMeasure:
    return CaptureMeasure(**{**one, "outlier": CaptureOutlier(**one["outlier"])})

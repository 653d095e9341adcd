"""Materials against a photograph, or against all photographs of a capture."""

import os
from collections.abc import Sequence
from typing import Any, Literal

from numpy.typing import NDArray

from . import _core, _reports
from ._arrays import from_bytes
from ._asked import Predictions, distinct, listed, numbered
from ._material import Source, opened
from ._progress import Report as Progress
from ._progress import reported
from ._report import report_of
from ._scenes import Scene


class PhotoReport(_reports.PhotoReport):
    """Materials against photographs, the smallest mean log difference first."""

    differences: tuple[NDArray[Any], ...]
    """From a single photograph, of each result: height x width x 3, NaN where the photograph is clipped."""


def photo(
    photo: Source,
    materials: Predictions,
    *,
    scene: Scene | Source | None = None,
    scene_number: int | None = None,
    flash: bool = False,
    fov: float | None = None,
    corners: Sequence[tuple[float, float]] | None = None,
    transfer: Literal["linear", "srgb", "gamma2.2"] | None = None,
    clip: float | None = None,
    falloff: bool = False,
    exposure: Literal["capture", "photograph"] | None = None,
    hold_out: Sequence[str] = (),
    difference: Literal["log", "absolute", "relative"] = "log",
    convention: str = "printed",
    progress: bool | Progress = False,
) -> PhotoReport:
    """Compares renderings of materials with a photograph, or with all photographs of a capture.

    Each material is rendered under the light and the view of each photograph (Algorithm 3). One factor brings the
    photographs to the exposure of the renderings. Beyond the four corners, nothing is aligned or calibrated.

    Args:
        photo: The photograph: PNG, JPEG, EXR or another picture format. Or the folder of a capture, or the file that
            lists its photographs: capture.json, or the JSON file (render.json) or camera_pos.txt of MaterialGAN;
            docs/photographs.md describes them.
        materials: One or several materials or paths.
        scene: The light and the view of a single photograph, or a scene file or a MaterialGAN capture (render.json).
        scene_number: The number of the scene in a file of several, from 0.
        flash: The light is a flash at the camera, which is straight above the middle of the material.
        fov: With `flash`: the angle that the width of the material spans at the camera, in degrees.
        corners: Corners of the material in a single photograph, in pixels: top left, top right, bottom right, bottom
            left; without, the whole picture.
        transfer: The transfer curve of the photographs; without, by the capture, or else linear for floats and PNG
            files that declare it, sRGB for other integers.
        clip: The stored value from which on a pixel is clipped, where 1 is the largest integer; without, by the
            capture, or else 1, and none for floats.
        falloff: Divides a single photograph by the falloff of a point light, (l.z / d)^3 at the distance d, which
            Algorithm 3 does not model.
        exposure: Whether one factor is fitted to all photographs of a capture (`"capture"`, the default), or one to
            each.
        hold_out: Names of photographs of a capture to which the exposure is not fitted.
        difference: The difference that `PhotoReport.differences` has.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A photograph, the capture, a material or the scene cannot be used.
        ValueError: Light and view of a photograph are missing, specified twice or those of a capture; the corners are
            not four; there is no material; or `clip` is not above 0.
    """
    if corners is not None and len(corners) != 4:
        raise ValueError(f"corners: expected 4, found {len(corners)}")
    if clip is not None and not 0 < clip < float("inf"):
        raise ValueError(f"clip: expected a number above 0, found {clip}")
    if flash != (fov is not None):
        raise ValueError("flash and fov: expected both or neither; a flash needs the field of view in degrees")
    if flash and scene is not None:
        raise ValueError("light and view of the photograph: expected either scene, or flash with fov")
    path = scene if isinstance(scene, str | os.PathLike) else None
    if scene_number is not None and path is None:
        raise ValueError("scene_number: expected only with the path of a scene file")
    found = [opened(material) for material in listed(materials, "materials")]
    asked = {
        "photo": photo,
        "names": distinct(found, numbered("material", len(found))),
        "scene": None if scene is None or isinstance(scene, str | os.PathLike) else tuple(scene),
        "scene_file": path,
        "scene_number": scene_number,
        "fov": fov,
        "corners": None if corners is None else [[float(x), float(y)] for x, y in corners],
        "transfer": transfer,
        "clip": clip,
        "falloff": falloff,
        "exposure": exposure,
        "hold_out": list(hold_out),
        "difference": difference,
        "convention": convention,
    }
    with reported("comparing", progress) as report:
        items = _core.photo([material._core for material in found], asked, report)
    differences = tuple(from_bytes(data, size, 3, "f32") for size, data in items["differences"])
    return report_of(PhotoReport, items["views"], differences=differences)

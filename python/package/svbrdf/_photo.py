"""Materials against a photograph."""

import os
from collections.abc import Sequence
from typing import Any, Literal

from numpy.typing import NDArray

from . import _core, _reports
from ._arrays import from_bytes
from ._asked import Predictions, photographed
from ._material import Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import report_of
from ._scenes import Scene, read_scenes


class PhotoReport(_reports.PhotoReport):
    """Materials against a photograph, the smallest mean log difference first."""

    differences: tuple[NDArray[Any], ...]
    """The difference of each result: height x width x 3, NaN where the photograph is clipped."""


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
    difference: Literal["log", "absolute", "relative"] = "log",
    convention: str = "printed",
    progress: bool | Progress = False,
) -> PhotoReport:
    """Compares renderings of materials with a photograph, at one exposure.

    Each material is rendered under the light and the view of the photograph (Algorithm 3). One factor brings the
    photograph to the exposure of the rendering. Beyond the four corners, nothing is aligned or calibrated.

    Args:
        photo: The photograph: PNG, JPEG, EXR or another picture format.
        materials: One or several materials or paths.
        scene: The light and the view, or a scene file or a MaterialGAN capture (render.json).
        scene_number: The number of the scene in a file of several, from 0.
        flash: The light is a flash at the camera, which is straight above the middle of the material.
        fov: With `flash`: the angle that the width of the material spans at the camera, in degrees.
        corners: Corners of the material in the photograph, in pixels: top left, top right, bottom right, bottom left;
            without, the whole picture.
        transfer: The transfer curve of the photograph; without, linear for floats and PNG files that declare it, sRGB
            for other integers.
        clip: The stored value from which on a pixel is clipped, where 1 is the largest integer; without, 1, and none
            for floats.
        falloff: Divides the photograph by the falloff of a point light, (l.z / d)^3 at the distance d, which Algorithm
            3 does not model.
        difference: The difference that `PhotoReport.differences` has.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: The photograph, a material or the scene cannot be used.
        ValueError: Light and view are missing, or specified twice, or the corners are not four.
    """
    if corners is not None and len(corners) != 4:
        raise ValueError(f"corners: expected 4, found {len(corners)}")
    chosen = _scene(scene, scene_number, flash, fov)
    asked = photographed(
        materials,
        transfer=transfer,
        clip=clip,
        photo=photo,
        scene=None if chosen is None else tuple(chosen),
        fov=fov,
        corners=None if corners is None else [[float(x), float(y)] for x, y in corners],
        falloff=falloff,
        difference=difference,
        convention=convention,
    )
    with reported("rendering", progress) as report:
        found = _core.photo(*asked, report)
    differences = tuple(from_bytes(data, size, 3, "f32") for size, data in found["differences"])
    return report_of(PhotoReport, found["views"], differences=differences)


def _scene(scene: Scene | Source | None, number: int | None, flash: bool, fov: float | None) -> Scene | None:
    """The scene; None for a flash."""
    if flash != (fov is not None):
        raise ValueError("flash and fov: expected both or neither; a flash needs the field of view in degrees")
    if flash == (scene is not None):
        raise ValueError("light and view of the photograph: expected either scene, or flash with fov")
    if not isinstance(scene, str | os.PathLike):
        if number is not None:
            raise ValueError("scene_number: expected only with the path of a scene file")
        return scene
    scenes = read_scenes(scene)
    if (number is None and len(scenes) > 1) or (number is not None and not 0 <= number < len(scenes)):
        found = "" if number is None else f", found {number}"
        raise ValueError(
            f"scene_number: {os.fspath(scene)} lists {len(scenes)} scenes, of which a photograph has one{found}; "
            f"give its number from 0 to {len(scenes) - 1}"
        )
    return scenes[number or 0]

"""Materials against a photograph, or against several of one material."""

from typing import Literal

from . import _core
from ._asked import Predictions, distinct, listed, numbered
from ._material import Source, opened
from ._progress import Report as Progress
from ._progress import reported
from ._report import report_of
from ._reports import PhotoReport
from ._scenes import Scene


def photo(
    photo: Source,
    materials: Predictions,
    *,
    scene: Scene | None = None,
    transfer: Literal["linear", "srgb", "gamma2.2"] | None = None,
    falloff: bool = False,
    convention: str = "printed",
    progress: bool | Progress = False,
) -> PhotoReport:
    """Compares renderings of materials with a rectified photograph, or with several.

    Each material is rendered under the light and the view of each photograph (Algorithm 3). One factor brings the
    photographs to the exposure of the renderings. Nothing else is aligned or calibrated.

    Args:
        photo: The photograph, which the material fills: PNG, JPEG, EXR or another picture format. Or a folder with
            capture.json or MaterialGAN's render.json, or such a file; docs/photographs.md describes them.
        materials: One or several materials or paths.
        scene: The light and the view of a single photograph.
        transfer: The transfer curve of a single photograph; without, linear for floats and PNG files that declare it,
            sRGB for other integers.
        falloff: Divides out the falloff of a point light, which Algorithm 3 does not model.
        convention: A name of `svbrdf.CONVENTIONS`.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A photograph, the list, a material or the scene cannot be used.
        ValueError: Light and view of a photograph are missing, or there is no material.
    """
    found = [opened(material) for material in listed(materials, "materials")]
    asked = {
        "photo": photo,
        "names": distinct(found, numbered("material", len(found))),
        "scene": None if scene is None else tuple(scene),
        "transfer": transfer,
        "falloff": falloff,
        "convention": convention,
    }
    with reported("comparing", progress) as report:
        return report_of(PhotoReport, _core.photo([material._core for material in found], asked, report))

"""Materials against the photographs of a capture."""

from collections.abc import Sequence
from typing import Literal

from . import _core
from ._asked import Predictions, photographed
from ._material import Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import report_of
from ._reports import CaptureReport


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
    return report_of(CaptureReport, found)

"""The report for any browser, and its figure in a notebook."""

import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from . import _core
from ._asked import Asked, Predictions
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._scenes import Scene

HEADLIGHT = Scene("near", view=(0, 0, 2.5), light=(0.4, 0.5, 1.2))
Layout = Literal["side-by-side", "wipe", "single"]


@dataclass(frozen=True, repr=False)
class Figure:
    """An interactive figure; a notebook shows it."""

    html: str
    """The page: a file of this text opens in any browser, and in an `<iframe>` of a page."""
    height: int
    """Its height in a notebook, in CSS pixels."""

    def _repr_html_(self) -> str:
        # The frame runs the scripts of the page alone, named by their hashes, and reaches nothing of the notebook.
        page = self.html.replace("&", "&amp;").replace('"', "&quot;")
        style = f"width: 100%; height: {self.height}px; border: 0"
        return f'<iframe sandbox="allow-scripts" title="svbrdf figure" style="{style}" srcdoc="{page}"></iframe>'

    def __repr__(self) -> str:
        return f"<svbrdf.Figure, {len(self.html.encode()):,} bytes of HTML>"


def figure(
    ground_truth: Material | Source,
    predictions: Predictions = (),
    *,
    scene: Scene = HEADLIGHT,
    exposure: float | None = None,
    layout: Layout = "side-by-side",
    convention: str = "printed",
    height: int = 720,
    max_size: int = 2_000_000,
    progress: bool | Progress = False,
) -> Figure:
    """The interactive figure of materials, as the last expression of a cell of a notebook: light and view to drag.

    >>> import svbrdf
    >>> ground_truth, *predictions = svbrdf.built_in()
    >>> figure = svbrdf.figure(ground_truth, predictions)
    >>> figure.html.startswith("<!doctype html>")
    True

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths; none shows the first material alone.
        scene: The light and the view that it begins with.
        exposure: In stops, from -16 to 16; None: the brightest 1% of the ground truth just clip.
        layout: The layout that it begins with.
        convention: A name of `svbrdf.CONVENTIONS`.
        height: Its height in a notebook, in CSS pixels.
        max_size: Most bytes: its maps are halved until it has as many, with a warning.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or the scene cannot be used, the sizes differ, or an option has no such value.
    """
    asked = Asked(ground_truth, predictions, {}, convention, alone=True)
    return Figure(_page(asked, _options(scene, exposure, layout, max_size), progress), height)


def report(
    ground_truth: Material | Source,
    predictions: Predictions,
    path: Source,
    *,
    target_error: float = 0.01,
    seed: int = 0,
    scene: Scene = HEADLIGHT,
    exposure: float | None = None,
    layout: Layout = "side-by-side",
    convention: str = "printed",
    max_size: int = 10_000_000,
    progress: bool | Progress = False,
) -> None:
    """Writes the report of `svbrdf report`: one HTML file with the interactive figure and the findings.

    `path` ends with .html; the file appears when it is complete, or not at all. `target_error` and `seed` are those of
    `svbrdf.loss`, the other args and errors those of `svbrdf.figure`.
    """
    asked = Asked(ground_truth, predictions, {"seed": seed, "target_error": target_error}, convention)
    named = f"{target_error=}, {seed=}, {exposure=}, {layout=}, {convention=}, {max_size=}, scene=svbrdf.{scene!r}"
    first, *others = [_call(material) for material in asked.materials]
    options = _options(scene, exposure, layout, max_size) | {
        "call": f"svbrdf.report({first}, [{', '.join(others)}], {os.fspath(path)!r}, {named})",
        "readings": [_reading(material) for material in asked.materials],
        "path": Path(path),
    }
    _page(asked, options, progress)


def _options(scene: Scene, exposure: float | None, layout: str, max_size: int) -> dict[str, Any]:
    given = {"scene": tuple(scene), "exposure": exposure, "layout": layout, "max_bytes": max_size}
    return given | {"readings": [], "call": None, "path": None}


def _page(asked: Asked, options: dict[str, Any], progress: bool | Progress) -> str:
    with reported("rendering", progress) as told:
        found = _core.page(asked.core, options, told)
    for warning in found["warnings"]:
        warnings.warn(warning, stacklevel=3)
    return found["html"]


def _call(material: Material) -> str:
    """What makes this material in Python; of arrays, their names alone."""
    if material.path is None:
        return f"<svbrdf.Material {material.name!r}>"
    given = [f", {name}={value!r}" for name, value in (material._options or {}).items() if value is not None]
    return f"svbrdf.read({material.path!r}{''.join(given)})"


def _reading(material: Material) -> list[str]:
    return [*(f"{what}: {chosen}: {why}" for what, chosen, why, _ in material.assumptions), *material.notes]

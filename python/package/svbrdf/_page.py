"""The report for any browser, and its figure in a notebook."""

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from . import _core
from ._asked import Asked, Predictions
from ._material import Material, Source
from ._progress import Report as Progress
from ._progress import reported
from ._scenes import Scene
from ._show import HEADLIGHT

Layout = Literal["side-by-side", "wipe", "single"]
CONTROLS = 250
"""The height of what a figure has beside its pictures, in CSS pixels: it takes two or three rows of controls."""


@dataclass(frozen=True, repr=False)
class Figure:
    """An interactive figure; a notebook shows it."""

    html: str
    """The page: a file of this text opens in any browser, and in an `<iframe>` of a page."""
    height: int
    """Its largest height in a notebook, in CSS pixels."""
    share: float = 1.0
    """The height of the pictures, as a share of the width of the figure."""

    def _repr_html_(self) -> str:
        # The frame runs the scripts of the page alone, named by their hashes, and reaches nothing of the notebook.
        page = self.html.replace("&", "&amp;").replace('"', "&quot;")
        high = f"min({self.height}px, calc({100 * self.share:.1f}cqw + {CONTROLS}px))"
        style = f"width: 100%; height: {self.height}px; height: {high}; border: 0"
        frame = f'<iframe sandbox="allow-scripts" title="svbrdf figure" style="{style}" srcdoc="{page}"></iframe>'
        return f'<div style="container-type: inline-size">{frame}</div>'

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
        height: Its largest height in a notebook, in CSS pixels: it is as high as its pictures and controls take.
        max_size: Most bytes: its maps are halved until it has as many, with a warning.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or the scene cannot be used, the sizes differ, or an option has no such value.
        ValueError: `exposure`, `height` or `max_size` is out of its range.
    """
    if not 50 <= height <= 10_000:
        raise ValueError(f"height: expected CSS pixels from 50 to 10000, found {height}")
    asked = Asked(ground_truth, predictions, convention=convention, alone=True)
    options = _options(scene, exposure, max_size, layout=layout)
    count = 1 + len(asked.predictions) if layout == "side-by-side" else 1
    return Figure(_page(asked, options, progress), height, _share(asked.ground_truth.size, count, height))


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
    about: Mapping[str, str] | Source | None = None,
    progress: bool | Progress = False,
) -> None:
    """Writes the report of `svbrdf report`: one HTML file with the interactive figure and the findings.

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials of the same size, or paths.
        path: The file, .html. It appears when it is complete, or not at all.
        target_error: As many scenes as this relative error of the losses needs at 95% confidence.
        seed: Names the sampled scenes.
        scene: The light and the view that the figure begins with.
        exposure: In stops, from -16 to 16; None: the brightest 1% of the ground truth just clip.
        layout: The layout that the figure begins with.
        convention: A name of `svbrdf.CONVENTIONS`.
        max_size: Most bytes of the file: the maps of the figure are halved until it has as many, with a warning.
        about: Texts of the page, or the path of a TOML file with them: `title`, `authors`, `caption`, `bibtex`, and
            `image`, the address of a picture for previews of links.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read or written.
        svbrdf.Error: A material or the scene cannot be used, the sizes differ, or `path` is not named like HTML.
            `about` has other keys, or values that are no texts.
        ValueError: `target_error` is no share, or `exposure` or `max_size` is out of its range.
    """
    asked = Asked(ground_truth, predictions, convention=convention, seed=seed, target_error=target_error)
    materials = [asked.ground_truth, *asked.predictions]
    named = f"{target_error=}, {seed=}, {exposure=}, {layout=}, {convention=}, {max_size=}, scene=svbrdf.{scene!r}"
    texts = [_call(material) for material in materials]
    options = _options(scene, exposure, max_size, layout=layout)
    if about is not None:
        about = dict(about) if isinstance(about, Mapping) else os.fspath(about)
        named += f", {about=}"
        options["about"] = (json.dumps(about), None) if isinstance(about, dict) else (None, about)
    options["call"] = f"svbrdf.report({texts[0]}, [{', '.join(texts[1:])}], {os.fspath(path)!r}, {named})"
    options["readings"] = [_reading(material) for material in materials]
    options["path"] = Path(path)
    _page(asked, options, progress)


def _share(size: tuple[int, int], count: int, height: int) -> float:
    """The height of `count` panes of a figure as a share of its width, where it is as wide as in most notebooks."""
    width, aspect = 1000.0, min(max(size[0] / size[1], 0.4), 2.5)
    rows = {columns: -(-count // columns) for columns in range(1, count + 1)}
    heights = {columns: min(width / columns / aspect, 0.68 * height / rows[columns]) for columns in rows}
    best = max(rows, key=lambda columns: (round(heights[columns]), columns))
    return 0.95 * rows[best] / best / aspect


def _options(scene: Scene, exposure: float | None, max_size: int, *, layout: str) -> dict[str, Any]:
    if exposure is not None and not -16 <= exposure <= 16:
        raise ValueError(f"exposure: expected stops from -16 to 16, found {exposure}")
    if max_size <= 0:
        raise ValueError(f"max_size: expected bytes above 0, found {max_size}")
    return {
        "scene": (scene.kind, scene.view, scene.light),
        "exposure": exposure,
        "layout": layout,
        "max_bytes": max_size,
        "readings": [],
        "about": (None, None),
        "call": None,
        "path": None,
    }


def _page(asked: Asked, options: dict[str, Any], progress: bool | Progress) -> str:
    with reported("rendering", progress) as told:
        found = _core.page(*asked.core, options, told)
    for warning in found["warnings"]:
        warnings.warn(warning, stacklevel=3)
    return found["html"]


def _call(material: Material) -> str:
    """What makes this material in Python; of arrays, their names alone."""
    if material.path is None:
        return f"<svbrdf.Material {material.name!r}>"
    options: dict[str, Any] = json.loads(material._options or "{}")
    given = [f", {name.replace('-', '_')}={value!r}" for name, value in options.items() if value is not None]
    return f"svbrdf.read({material.path!r}{''.join(given)})"


def _reading(material: Material) -> Sequence[str]:
    return [*(f"{what}: {chosen}: {why}" for what, chosen, why, _ in material.assumptions), *material.notes]

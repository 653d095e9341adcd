"""Whose renderer it is."""

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._report import report_of
from ._reports import ConformReport

_MAPS = ("normal", "diffuse", "specular", "roughness", "base_color", "metallic")


def probes() -> dict[str, NDArray[np.float64]]:
    """The points that `svbrdf conform --points` writes: arrays by name."""
    return {name: np.reshape(values, shape) for name, shape, values in _core.probes()}


def conform(
    render: Callable[[dict[str, NDArray[Any]], NDArray[Any], NDArray[Any]], Any],
    *,
    convention: str = "printed",
    workflow: Literal["diffuse", "metallic"] | None = None,
) -> ConformReport:
    """Tells whose renderer `render` is, and in which terms it differs from a convention.

    Args:
        render: A function of (maps, view, light) that returns the radiance of each point as n x 3 values, under one
            white light. `maps` has `normal`, `diffuse`, `specular` and `base_color` (n x 3), `roughness` and
            `metallic` (n); `view` and `light` (n x 3) lead from the points to camera and light, and are not unit.
        convention: A name that `svbrdf conventions` lists, or the path of a .toml file.
        workflow: The maps that `render` reads; without, whichever fits.

    Raises:
        OSError: The file of a convention cannot be read.
        svbrdf.Error: The convention is unknown, or `render` does not return n x 3 numbers.
    """
    points = probes()
    maps = {name: points[name] for name in _MAPS}
    given = points | {"radiance": np.asarray(render(maps, points["view"], points["light"]), dtype=np.float64)}
    arrays = [(name, list(values.shape), values.ravel().tolist()) for name, values in given.items()]
    metallic = None if workflow is None else workflow == "metallic"
    return report_of(ConformReport, _core.conform(arrays, convention, metallic))

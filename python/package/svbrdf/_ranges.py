"""Ranges of maps before training: values with which a loss would be NaN, without a gradient, or of another material."""

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._assumptions import AssumptionWarning
from ._normals import looks_unsigned


def check_map(where: str, map: NDArray[Any]) -> None:
    """Whether the values of a map, channels first, are those of a material; `where` is the argument and the map.

    Raises:
        ValueError: Values are NaN or infinite, colours or roughness are not in [0, 1], or normals have no length.
    """
    finite = np.isfinite(map)
    if not finite.all():
        wrong = finite.size - np.count_nonzero(finite)
        raise ValueError(
            f"{where}: {wrong} of {finite.size} values are NaN or infinite; replace them, or find their cause"
        )
    if where.endswith("normal"):
        _check_normals(where, np.moveaxis(map, -3, -1))
    elif map.size and not (map.min() >= 0 and map.max() <= 1):
        low, high = map.min(), map.max()
        raise ValueError(f"{where}: expected values in [0, 1], found {low:.3g} to {high:.3g}; {_remedy(low, high)}")


def _remedy(low: float, high: float) -> str:
    if low >= 0 and high > 2:
        return "divide by the largest value of their type, such as 255"
    if -1 <= low < 0 and high <= 1:
        return "give (x + 1) / 2 of the outputs x of tanh, or end the network in a sigmoid"
    return "clamp them, or end the network in a sigmoid"


def _check_normals(where: str, normal: NDArray[Any]) -> None:
    squared = np.einsum("...i,...i->...", normal, normal)
    without = np.count_nonzero(squared < np.finfo(squared.dtype).tiny)
    if without:
        raise ValueError(
            f"{where}: {without} of {squared.size} normals have no length, and so no gradient; "
            "give (0, 0, 1) there, as by adding it to the outputs of the network"
        )
    reason = looks_unsigned(normal.reshape(-1, *normal.shape[-2:]))
    if reason is not None:
        remedy = "give 2 * normal - 1 if they are stored as (n + 1) / 2, else check=False"
        warnings.warn(f"{where}: {reason}; {remedy}", AssumptionWarning, stacklevel=2)

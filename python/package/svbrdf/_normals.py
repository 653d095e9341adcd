"""How the components of normals are stored in arrays."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._arrays import as_array, check_shape, numbers

NormalEncoding = Literal["unsigned", "signed", "xy", "ag"]

CHANNELS: dict[str, tuple[int, ...]] = {"unsigned": (3,), "signed": (3,), "xy": (2, 3), "ag": (4,)}
"""The numbers of channels that an array of an encoding may have."""

FAR_FROM_1 = 0.02
"""Lengths that differ from 1 by more are not those of unit normals."""
FEW = 0.01
"""So small a share of such lengths says nothing."""


def as_normals(given: object, encoding: str | None, precision: str) -> tuple[NDArray[Any], bool]:
    """The normals as an array that the core reads, and whether its channels are planes.

    Args:
        given: As for `as_array`, with the channels of the encoding.
        encoding: A word of `NormalEncoding`; None: signed.
        precision: "f32" or "f64".

    Raises:
        TypeError: The numbers are not floating-point ones.
        ValueError: The shape is another one, texels are masked, or there is no such encoding.
    """
    if encoding is None or encoding == "signed":
        return as_array("normal", given, 3, precision)
    if encoding not in CHANNELS:
        raise ValueError(f"normal_encoding: expected one of {', '.join(CHANNELS)}, found {encoding!r}")
    stored = numbers("normal", given)
    check_shape("normal", stored, CHANNELS[encoding])
    return as_array("normal", _decoded(stored.astype(np.float64, copy=False), encoding), 3, precision)


def _decoded(stored: NDArray[Any], encoding: str) -> NDArray[Any]:
    """The vectors that are stored in [0, 1], as the reader of files decodes them."""
    if encoding == "unsigned":
        return 2 * stored - 1
    xy = 2 * stored[..., [3, 1] if encoding == "ag" else [0, 1]] - 1
    z = np.sqrt(np.maximum(1 - (xy * xy).sum(axis=-1, keepdims=True), 0))
    return np.concatenate([xy, z], axis=-1)


def looks_unsigned(normal: NDArray[Any]) -> str | None:
    """Why normals, height x width x 3, may be stored as (n + 1) / 2: no x or y is negative, and lengths are not 1."""
    xy = normal[..., :2]
    if not (normal.size and xy.min() >= 0 and xy.max() > 0):
        return None
    far, shortest, longest = 0, np.inf, 0.0
    # Few rows at a time, which take little memory.
    for rows in np.array_split(normal, max(1, min(len(normal), normal.size >> 18))):
        lengths = np.sqrt(np.einsum("...i,...i->...", rows, rows))
        far += int(np.count_nonzero(np.abs(lengths - 1) > FAR_FROM_1))
        shortest, longest = min(shortest, lengths.min()), max(longest, lengths.max())
    if far <= FEW * xy[..., 0].size:
        return None
    return f"no x or y is negative, and lengths are {shortest:.2f} to {longest:.2f}, not 1"

"""Maps as numpy arrays."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Precision = Literal["f32", "f64"]
FAR_FROM_1 = 0.02
"""Lengths that differ from 1 by more are not those of unit normals."""
FEW = 0.01
"""So small a share of such lengths says nothing."""


def as_array(name: str, given: object, channels: int, precision: str) -> NDArray[Any]:
    """The map `name` as an array that the core reads.

    Args:
        name: The name of the argument, for errors.
        given: An array, a tensor on the CPU, or what numpy makes an array of: HxWx3, or HxW for one channel.
        channels: 3 or 1.
        precision: "f32" or "f64".

    Raises:
        TypeError: The numbers are not floating-point ones.
        ValueError: The shape is another one, or texels are masked.
    """
    if isinstance(given, np.ma.MaskedArray) and np.any(given.mask):
        raise ValueError(f"{name}: expected a value in every texel, found masked ones; fill or crop them")
    array = _numpy(name, given)
    if array.dtype.kind != "f":
        raise TypeError(
            f"{name}: expected floating-point numbers, found {array.dtype}; convert them, as in {name} / 255"
        )
    if channels == 1 and array.ndim == 3 and array.shape[2] == 1:
        array = array[..., 0]
    _check_shape(name, array, channels)
    array = array.astype(np.float64 if precision == "f64" else np.float32, copy=False)
    # The memory of a tensor of 3 x height x width whose channels were moved to the end.
    flags = (array.transpose(2, 0, 1) if channels == 3 else array).flags
    if flags.c_contiguous and flags.aligned:
        return array
    # A copy only where the array has not this layout.
    return np.require(array, requirements=["C_CONTIGUOUS", "ALIGNED"])


def as_mask(given: object, size: tuple[int, int]) -> NDArray[np.bool_]:
    """Which texels are compared, as the core reads it.

    Args:
        given: An array, or what numpy makes an array of.
        size: The (height, width) that it must have.

    Raises:
        TypeError: These are no booleans.
        ValueError: The shape is another one.
    """
    mask = np.asarray(given)
    if mask.dtype != np.bool_:
        raise TypeError(f"mask: expected booleans, found {mask.dtype}; compare its values, as in mask > 0.5")
    if mask.shape != size:
        expected, found = (" x ".join(map(str, shape)) or "one value" for shape in (size, mask.shape))
        raise ValueError(f"mask: expected the height x width of the ground truth, {expected}, found {found}")
    return np.ascontiguousarray(mask)


def _check_shape(name: str, array: NDArray[Any], channels: int) -> None:
    if channels == 1:
        fits, expected = array.ndim == 2, "height x width"
    else:
        fits, expected = array.ndim == 3 and array.shape[2] == channels, f"height x width x {channels}"
    if not fits:
        found = " x ".join(map(str, array.shape)) or "a number"
        is_first = array.ndim == 3 and array.shape[0] == channels == 3
        advice = "move the channels to the end" if is_first else "reshape it"
        raise ValueError(f"{name}: expected {expected}, found {found}; {advice}")


def _numpy(name: str, given: object) -> NDArray[Any]:
    if isinstance(given, np.ndarray):
        return given
    if getattr(given, "requires_grad", False):
        given = given.detach()  # type: ignore[attr-defined]
    try:
        if hasattr(given, "__array__") or not hasattr(given, "__dlpack__"):
            return np.asarray(given)
        return np.from_dlpack(given)
    except (TypeError, ValueError, RuntimeError, BufferError) as error:
        raise TypeError(f"{name}: expected an array in the memory of the CPU: {error}") from error


def looks_unsigned(normal: NDArray[Any]) -> str | None:
    """Why normals, height x width x 3, may be stored as (n + 1) / 2: few x or y are negative, and lengths are not 1."""
    xy = normal[..., :2]
    # Filters overshoot.
    if not (normal.size and np.count_nonzero(xy < 0) <= FEW * xy.size and xy.max() > 0):
        return None
    far, shortest, longest = 0, np.inf, 0.0
    # Few rows at a time, which take little memory.
    for rows in np.array_split(normal, max(1, min(len(normal), normal.size >> 18))):
        lengths = np.sqrt(np.einsum("...i,...i->...", rows, rows))
        far += int(np.count_nonzero(np.abs(lengths - 1) > FAR_FROM_1))
        shortest, longest = min(shortest, lengths.min()), max(longest, lengths.max())
    if far <= FEW * xy[..., 0].size:
        return None
    word = "no" if xy.min() >= 0 else "hardly any"
    return f"{word} x or y is negative, and lengths are {shortest:.2f} to {longest:.2f}, not 1"

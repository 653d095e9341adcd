"""Maps as numpy arrays."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Precision = Literal["f32", "f64"]


def dtype_of(precision: str) -> np.dtype[Any]:
    """The type of the numbers of a precision."""
    return np.dtype(np.float64 if precision == "f64" else np.float32)


def as_array(name: str, given: object, channels: int, precision: str) -> tuple[NDArray[Any], bool]:
    """The map `name` as an array that the core reads, and whether its channels are planes.

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
    expected = "height x width x 3" if channels == 3 else "height x width"
    if array.ndim != (3 if channels == 3 else 2) or (channels == 3 and array.shape[2] != 3):
        found = " x ".join(map(str, array.shape)) or "a number"
        advice = "move the channels to the end" if channels == 3 and array.shape[:1] == (3,) else "reshape it"
        raise ValueError(f"{name}: expected {expected}, found {found}; {advice}")
    array = array.astype(dtype_of(precision), copy=False)
    if channels == 3:
        # The memory of a tensor of 3 x height x width whose channels were moved to the end.
        planes = array.transpose(2, 0, 1)
        if planes.flags.c_contiguous and planes.flags.aligned:
            return planes, True
    # A copy only where the array has not this layout.
    return np.require(array, requirements=["C_CONTIGUOUS", "ALIGNED"]), False


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


def from_bytes(data: bytearray, size: tuple[int, int], channels: int, precision: str) -> NDArray[Any]:
    """The array of a map of `size` (width, height)."""
    width, height = size
    shape = (height, width, 3) if channels == 3 else (height, width)
    return np.frombuffer(data, dtype_of(precision)).reshape(shape)

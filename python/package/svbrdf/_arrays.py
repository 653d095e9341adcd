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
    array = numbers(name, given)
    if channels == 1 and array.ndim == 3 and array.shape[2] == 1:
        array = array[..., 0]
    check_shape(name, array, (channels,))
    array = array.astype(dtype_of(precision), copy=False)
    if channels == 3:
        # The memory of a tensor of 3 x height x width whose channels were moved to the end.
        planes = array.transpose(2, 0, 1)
        if planes.flags.c_contiguous and planes.flags.aligned:
            return planes, True
    # A copy only where the array has not this layout.
    return np.require(array, requirements=["C_CONTIGUOUS", "ALIGNED"]), False


def numbers(name: str, given: object) -> NDArray[Any]:
    """The map `name` as an array of floating-point numbers, none of them masked.

    Raises:
        TypeError: The numbers are not floating-point ones.
        ValueError: Texels are masked.
    """
    if isinstance(given, np.ma.MaskedArray) and np.any(given.mask):
        raise ValueError(f"{name}: expected a value in every texel, found masked ones; fill or crop them")
    array = _numpy(name, given)
    if array.dtype.kind != "f":
        raise TypeError(
            f"{name}: expected floating-point numbers, found {array.dtype}; convert them, as in {name} / 255"
        )
    return array


def check_shape(name: str, array: NDArray[Any], channels: tuple[int, ...]) -> None:
    """Whether a map is height x width x one of `channels`, or height x width where it has one channel.

    Raises:
        ValueError: It has another shape.
    """
    if channels == (1,):
        fits, expected = array.ndim == 2, "height x width"
    else:
        fits = array.ndim == 3 and array.shape[2] in channels
        expected = f"height x width x {' or '.join(map(str, channels))}"
    if not fits:
        found = " x ".join(map(str, array.shape)) or "a number"
        is_first = array.ndim == 3 and channels != (1,) and array.shape[0] in channels
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


def from_bytes(data: bytearray, size: tuple[int, int], channels: int, precision: str) -> NDArray[Any]:
    """The array of a map of `size` (width, height)."""
    width, height = size
    shape = (height, width, 3) if channels == 3 else (height, width)
    return np.frombuffer(data, dtype_of(precision)).reshape(shape)

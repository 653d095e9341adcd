"""Maps of a batch of materials as tensors of PyTorch, and checks of them."""

import functools
import warnings
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from ._arrays import looks_unsigned
from ._material import AssumptionWarning

_F = TypeVar("_F", bound=Callable[..., Any])
# PyTorch 1.13 has no compiler.
_compiler: Any = getattr(torch, "compiler", None)
is_compiling: Callable[[], bool] = getattr(_compiler, "is_compiling", lambda: False)


def outside_of_graph(function: _F) -> _F:
    """The function, outside of each graph of `torch.compile`; without a compiler as it is, which is faster to call."""
    disabled = getattr(_compiler, "disable", lambda one: one)(function)

    @functools.wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        return (disabled if is_compiling() else function)(*args, **kwargs)

    return called  # type: ignore[return-value]


class Maps(NamedTuple):
    """The four maps of a batch of materials, channels first."""

    normal: Tensor
    """... x 3 x H x W: x right, y up, z out of the surface, row 0 on top; of any length."""
    diffuse: Tensor
    """... x 3 x H x W: linear RGB in [0, 1]."""
    specular: Tensor
    """... x 3 x H x W: reflectance at normal incidence, linear RGB in [0, 1]."""
    roughness: Tensor
    """... x 1 x H x W: in [0, 1]; the GGX width is its square."""


def working_type(*materials: Maps) -> torch.dtype:
    """The type to compute in: that of the maps, float32 or wider."""
    dtype = torch.float32
    for maps in materials:
        for map in maps:
            dtype = torch.promote_types(dtype, map.dtype)
    return dtype


@outside_of_graph
def check_shapes(**materials: Maps) -> None:
    """Whether all maps have their channels, one height and width, and the same batch dimensions or none."""
    named = [(f"{which}.{name}", map) for which, maps in materials.items() for name, map in _items(which, maps)]
    height, width = named[0][1].shape[-2:]
    batch_of, batch = next(((name, map.shape[:-3]) for name, map in named if map.dim() > 3), ("", ()))
    for (name, map), channels in zip(named, (3, 3, 3, 1) * len(materials), strict=True):
        *dims, found_channels, found_height, found_width = map.shape if map.dim() > 2 else (0, 0, 0)
        if (found_channels, found_height, found_width) != (channels, height, width):
            raise ValueError(
                f"{name}: expected ... x {channels} x {height} x {width}, found {_by(map.shape)}; reshape it"
            )
        if dims and tuple(dims) != batch:
            raise ValueError(
                f"{name}: expected the batch dimensions of {batch_of}, {_by(batch)}, or none, found {_by(map.shape)}; "
                "give one material for a whole batch without batch dimensions"
            )


def _by(shape: Sequence[int]) -> str:
    return " x ".join(str(length) for length in shape)


def _items(which: str, maps: Maps) -> list[tuple[str, Tensor]]:
    if not isinstance(maps, tuple) or len(maps) != len(Maps._fields):
        fields = ", ".join(f"{name}=" for name in Maps._fields)
        raise TypeError(f"{which}: expected svbrdf.torch.Maps, found {type(maps).__name__}; make one by Maps({fields})")
    items = list(zip(Maps._fields, maps, strict=True))
    for name, map in items:
        if not isinstance(map, Tensor):
            raise TypeError(f"{which}.{name}: expected a tensor, found {type(map).__name__}; see torch.as_tensor")
    return items


def check_values(**materials: Maps) -> None:
    """Whether the values of the maps are those of materials; waits for the device, and copies the maps to the CPU.

    Raises:
        ValueError: They are not. Normals that look stored in [0, 1] are a `svbrdf.AssumptionWarning`.
    """
    for which, maps in materials.items():
        for name, map in zip(Maps._fields, maps, strict=True):
            _check_map(f"{which}.{name}", map.detach().to("cpu", working_type(maps)).numpy())


def _check_map(where: str, map: NDArray[Any]) -> None:
    finite = np.isfinite(map)
    if not finite.all():
        wrong = finite.size - np.count_nonzero(finite)
        raise ValueError(
            f"{where}: {wrong} of {finite.size} values are NaN or infinite; replace them, or find their cause"
        )
    if where.endswith("normal"):
        _check_normals(where, np.moveaxis(map, -3, -1))
    elif map.size and not (map.min() >= 0 and map.max() <= 1):
        raise ValueError(
            f"{where}: expected values in [0, 1], found {map.min():.3g} to {map.max():.3g}; "
            "scale or clamp them, or end the network in a sigmoid"
        )


def _check_normals(where: str, normal: NDArray[Any]) -> None:
    squared = np.einsum("...i,...i->...", normal, normal)
    without = np.count_nonzero(squared < np.finfo(squared.dtype).tiny)
    if without:
        raise ValueError(
            f"{where}: {without} of {squared.size} normals have no length, and so no gradient; "
            "give (0, 0, 1) there, as by adding it to the outputs of the network"
        )
    if reason := looks_unsigned(normal.reshape(-1, *normal.shape[-2:])):
        remedy = "give 2 * normal - 1 if they are stored as (n + 1) / 2, else check=False"
        warnings.warn(f"{where}: {reason}; {remedy}", AssumptionWarning, stacklevel=2)

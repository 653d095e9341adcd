"""Maps of a batch of materials as tensors of PyTorch, and checks of them."""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import torch
from torch import Tensor

from ._ranges import check_map

_F = TypeVar("_F", bound=Callable[..., Any])
# PyTorch 1.13 has no compiler.
_compiler: Any = getattr(torch, "compiler", None)
is_compiling: Callable[[], bool] = getattr(_compiler, "is_compiling", lambda: False)
outside_of_graph: Callable[[_F], _F] = getattr(_compiler, "disable", lambda function: function)


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
        found = " x ".join(str(length) for length in map.shape)
        if tuple(map.shape[-3:]) != (channels, height, width):
            raise ValueError(f"{name}: expected ... x {channels} x {height} x {width}, found {found}; reshape it")
        if map.dim() > 3 and map.shape[:-3] != batch:
            expected = " x ".join(str(length) for length in batch)
            raise ValueError(
                f"{name}: expected the batch dimensions of {batch_of}, {expected}, or none, found {found}; "
                "give one material for a whole batch without batch dimensions"
            )


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
            check_map(f"{which}.{name}", map.detach().to("cpu", working_type(maps)).numpy())

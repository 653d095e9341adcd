"""The rendering loss on a card: loss and gradient from one Triton kernel, as operators of PyTorch.

The operators are opaque to `torch.compile`, which therefore compiles what contains them in one graph.
"""

import importlib.util
import os
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from math import prod
from typing import Any

import torch
from torch import Tensor

from ._maps import Maps, check_shapes, is_compiling, working_type
from ._scenes import CONVENTIONS, Convention

INTERPRETED = os.environ.get("TRITON_INTERPRET") == "1"
"""Whether Triton computes on the processor, as tests do; then tensors of the processor take the kernel, too."""
BLOCK = 128
"""Texels of one program of the kernel."""
_CHANNELS = (3, 3, 3, 1)
_custom_op: Any = getattr(torch.library, "custom_op", None)
_HAS_TRITON = importlib.util.find_spec("triton") is not None


def takes(map: Tensor) -> bool:
    """Whether the map is on a device of the kernel."""
    return bool(map.is_cuda) or INTERPRETED


def obstacle(convention: Convention, ground_truth: Sequence[Tensor]) -> str:
    """Why the kernel does not compute a loss on a card; empty: it does."""
    if not _HAS_TRITON or (_custom_op is None and not INTERPRETED):
        return "it needs PyTorch 2.4 or later with Triton"
    if convention.smith or convention.norm != "log-l1":
        return f"it has no renderer or norm of the convention `{convention.name}`"
    if torch.is_grad_enabled() and any(map.requires_grad for map in ground_truth):
        return "it has no gradient for the ground truth, which needs one here; detach it"
    return ""


def fused_loss(points: Tensor, convention: Convention, prediction: Maps, ground_truth: Maps) -> Tensor:
    """The mean loss over scenes and materials. Points are the endpoints of the scenes, on any device."""
    device = prediction[0].device
    if elsewhere := {str(map.device) for map in (*prediction, *ground_truth)} - {str(device)}:
        raise ValueError(f"maps: expected all on {device}, found some on {', '.join(elsewhere)}; move them by .to(...)")
    if points.device != device:
        points = points.to(device, non_blocking=True)
    wanted = torch.is_grad_enabled() and any(map.requires_grad for map in prediction)
    # The custom operator costs as much of the processor's time again, and is only needed in a graph.
    compute = _operator if is_compiling() else _Function.apply
    loss: Tensor = compute(points, convention.name, wanted, *prediction, *ground_truth)[0]
    return loss


def first_derivatives(factor: Tensor, gradients: Sequence[Tensor]) -> tuple[Tensor, ...]:
    """The gradients times a factor, which refuse to be differentiated."""
    if torch.is_grad_enabled():
        products: tuple[Tensor, ...] = _Once.apply(factor.detach().requires_grad_(), *gradients)
        return products
    return tuple(gradient * factor for gradient in gradients)


class _Once(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, factor: Tensor, *gradients: Tensor) -> tuple[Tensor, ...]:
        return tuple(gradient * factor for gradient in gradients)

    @staticmethod
    def backward(ctx: Any, *_: Tensor) -> Any:
        raise RuntimeError(
            "svbrdf.torch.RenderingLoss has first derivatives only; "
            "svbrdf.torch.scene_losses(prediction, ground_truth, scenes, convention).mean() has all"
        )


def _outputs(maps: Sequence[Tensor], wanted: bool) -> tuple[Tensor, Tensor]:
    """Memory for the loss and the gradient of a prediction and a ground truth."""
    dtype = working_type(Maps(*maps[:4]), Maps(*maps[4:]))
    values = sum(_CHANNELS) * prod(_batch(maps)) * prod(maps[0].shape[-2:]) if wanted else 0
    return maps[0].new_empty((), dtype=dtype), maps[0].new_empty(values, dtype=dtype)


def _batch(maps: Sequence[Tensor]) -> Sequence[int]:
    return next((map.shape[:-3] for map in maps if map.dim() > 3), ())


def _compute(
    points: Tensor,
    convention: str,
    wanted: bool,
    n: Tensor,
    d: Tensor,
    s: Tensor,
    r: Tensor,
    n0: Tensor,
    d0: Tensor,
    s0: Tensor,
    r0: Tensor,
) -> tuple[Tensor, Tensor]:
    """The loss, and its gradient for normal, diffuse, specular and roughness, one behind the other."""
    import triton

    from . import _kernel

    maps, one = (n, d, s, r, n0, d0, s0, r0), CONVENTIONS[convention]
    loss, gradient = _outputs(maps, wanted)
    height, width = n.shape[-2:]
    # Views where the strides allow: one stride for the batch, one for channels, one for texels.
    flat = [map.reshape(-1, map.shape[-3], height * width) for map in maps]
    strides = [
        (map.stride(0) if full.dim() > 3 else 0, *map.stride()[1:]) for map, full in zip(flat, maps, strict=True)
    ]
    texels = max(len(map) for map in flat) * height * width
    programs = triton.cdiv(texels, BLOCK)
    losses = loss.new_empty(programs)
    limits = torch.finfo(loss.dtype)
    # Triton launches on the current card.
    is_elsewhere = n.is_cuda and n.device.index != torch.cuda.current_device()
    with torch.cuda.device(n.device) if is_elsewhere else nullcontext():
        _kernel.loss_and_gradient[(programs,)](
            *(value for map, along in zip(flat, strides, strict=True) for value in (map, *along)),
            # Converting float64 for each texel would cost more than doing it once.
            *(points.to(loss.dtype), losses, gradient, texels, height * width, width, height, max(width - 1, 1)),
            SCENES=len(points),
            GRADIENT=wanted,
            BLOCK=BLOCK,
            T=triton.language.float64 if loss.dtype == torch.float64 else triton.language.float32,
            TINY=limits.tiny,
            MAX=limits.max,
            EQUAL=4 * limits.eps,
            INTENSITY=one.intensity,
            FLOOR=one.roughness_floor,
            LIGHT_Z=max(one.light_z_floor, limits.tiny),
            CLAMP=one.clamp_n_dot_h,
            D_FLOOR=one.d_floor or -limits.max,
            G_FLOOR=one.g_floor or -limits.max,
            EPSILON=one.epsilon,
        )
    return losses.sum(), gradient


def _setup(ctx: Any, inputs: tuple[Any, ...], output: tuple[Tensor, Tensor]) -> None:
    # The gradient of the second output, which nothing uses, is not made of zeros.
    ctx.set_materialize_grads(False)
    ctx.save_for_backward(output[1])
    maps = inputs[3:]
    ctx.shapes = [(*_batch(maps), channels, *maps[0].shape[-2:]) for channels in _CHANNELS]


def _backward(ctx: Any, factor: Tensor, _: Any) -> tuple[Tensor | None, ...]:
    # Autograd sums them over the batch where a map has none, and converts them to the type of the map.
    (scaled,) = first_derivatives(factor, ctx.saved_tensors)
    parts = scaled.split([prod(shape) for shape in ctx.shapes])
    of_maps = (part.view(shape) for part, shape in zip(parts, ctx.shapes, strict=True))
    return (None, None, None, *of_maps, None, None, None, None)


class _Function(torch.autograd.Function):
    """The loss outside of a graph."""

    @staticmethod
    def forward(ctx: Any, *inputs: Any) -> Any:
        output = _compute(*inputs)
        _setup(ctx, inputs, output)
        return output

    backward = staticmethod(_backward)


def operator(name: str, compute: Callable[..., Any], fake: Callable[..., Any]) -> Any:
    """The function as a custom operator, where PyTorch has them. `fake` makes outputs of the same shape and type."""
    if _custom_op is None:
        return compute
    made = _custom_op(name, mutates_args=())(compute)
    made.register_fake(fake)
    return made


def _fake(points: Tensor, convention: str, wanted: bool, *maps: Tensor) -> tuple[Tensor, Tensor]:
    check_shapes(prediction=Maps(*maps[:4]), ground_truth=Maps(*maps[4:]))
    return _outputs(maps, wanted)


_operator = operator("svbrdf::rendering_loss", _compute, _fake)
if _custom_op is not None:
    _operator.register_autograd(_backward, setup_context=_setup)

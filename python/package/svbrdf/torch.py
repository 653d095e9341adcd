"""The rendering loss in PyTorch, for training.

Plain PyTorch, to be read and changed. It computes what the core computes: Algorithms 1 and 3 of
Deschaintre et al. (2018-2020) in each of `svbrdf.CONVENTIONS`, whose renderer or norm may be another, in the scenes of
the same seeds. In float64 it agrees with the core within 1e-12, in float32 within 1e-5 (relative). No gradient is NaN:
not at roughness 0, not at l = -v, not on black texels. On a CUDA card, `RenderingLoss` is one kernel, in `_kernel.py`.

    loss = svbrdf.torch.RenderingLoss()
    for ground_truth, photo in batches:
        loss(network(photo), ground_truth).backward()

Every call samples new scenes, as the papers train; `seed` gives the same ones again. Without the kernel,
`torch.compile(loss)` computes the same several times faster. The scenes are sampled outside of the compiled graph: no
seed compiles anything anew.

Maps have channels first and any number of batch dimensions before them: normal, diffuse and specular ... x 3 x H x W,
roughness ... x 1 x H x W. Values are linear; colours and roughness lie in [0, 1]. Shapes are checked in every call,
since some wrong ones would broadcast to a wrong loss; values in the first call of a `RenderingLoss`.

Bound the outputs of a network: diffuse and specular by a sigmoid, roughness by 0.02 + 0.98 sigmoid(x); add (0, 0, 1)
to normals. The gradient along roughness falls with it, to 0 below the floor of the convention, and colours outside of
[0, 1] can make the loss NaN. Maps that are optimized without a network need `straight_through`.

A vector is three planes here, its components: ... x 1 x H x W each. Everything that depends on the scene alone is
`Geometry`, computed once per scene for all materials; everything that depends on the material alone is `Terms`,
computed once per material for all scenes.
"""

import warnings
from collections.abc import Sequence
from math import hypot, pi
from typing import Any, Literal, NamedTuple

import torch
from torch import Tensor

from . import _fused
from ._maps import Maps, check_shapes, check_values, is_compiling, outside_of_graph, working_type
from ._scenes import CONVENTIONS, Convention, Scene, sample_scenes

__all__ = [
    "Maps",
    "RenderingLoss",
    "check_scenes",
    "check_shapes",
    "check_values",
    "endpoints",
    "render",
    "scene_losses",
    "straight_through",
]

Vector = tuple[Tensor, Tensor, Tensor]


class RenderingLoss(torch.nn.Module):
    """The rendering loss: the mean over scenes, texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|.

    Where the norm of the convention is the mean square, that of (R_gt - R_pred)^2.

    Maps on a CUDA card take one Triton kernel for loss and gradient, in the conventions of Algorithm 3 and the log L1
    norm, unless the ground truth needs a gradient. Without it and without `torch.compile`, the gradient is computed
    together with the loss, scene after scene, in the memory of one scene. Both ways have first derivatives only;
    `scene_losses` has all.

    The scenes of a call are named by its `seed`. Without, they are new in each call, by the generator of PyTorch:
    `torch.manual_seed` makes a run repeatable. The papers train so, on 6 + 3 new scenes for every batch. Validate with
    one seed, so that losses of different steps can be compared.

    Args:
        convention: A name of `svbrdf.CONVENTIONS`.
        near: The number of sampled near-field scenes.
        distant: The number of sampled distant scenes.
        sampler: "random" or "sobol".
        scenes: These scenes, in place of sampled ones.
        straight_through: Whether diffuse, specular and roughness of the prediction are clamped to their limits with the
            gradient of values that are not, so that an optimizer can bring them back: see `straight_through`.
        check: Whether the first call checks the values of the maps, for which it copies them to the CPU.
        fused: Whether maps on a CUDA card take the fused kernel, where it has the convention.

    Raises:
        ValueError: There is no such convention, or no scene, or a light or view is not above the plane.
    """

    def __init__(
        self,
        *,
        convention: str = "printed",
        near: int = 6,
        distant: int = 3,
        sampler: Literal["random", "sobol"] = "random",
        scenes: Sequence[Scene] | None = None,
        straight_through: bool = False,
        check: bool = True,
        fused: bool = True,
    ) -> None:
        super().__init__()
        if convention not in CONVENTIONS:
            raise ValueError(f"unknown convention `{convention}`; use one of: {', '.join(CONVENTIONS)}")
        if scenes is not None:
            check_scenes(scenes)
        self.convention = CONVENTIONS[convention]
        self.near, self.distant = near, distant
        self.sampler: Literal["random", "sobol"] = sampler
        self.scenes = scenes
        self._given = None if scenes is None else endpoints(scenes)
        self.straight_through = straight_through
        self.check = check
        self.fused = fused
        self._is_told = not fused

    def forward(
        self, prediction: Maps, ground_truth: Maps, *, seed: int | None = None, points: Tensor | None = None
    ) -> Tensor:
        """The mean loss of a batch, over the scenes that `seed` names; None: new ones.

        `points` are the `endpoints` of scenes to use instead, such as a tensor on the card that a CUDA graph reads.

        Raises:
            TypeError: A material is not `Maps` of tensors.
            ValueError: A map has another shape or, in the first call, values that are not those of a material.
            RuntimeError: A CUDA graph is captured without `points`: its replays would not sample.
        """
        is_compiled = is_compiling()
        if not is_compiled:
            self._check(prediction, ground_truth)
        is_fused = self.fused and _fused.takes(prediction[0]) and not _fused.obstacle(self.convention, ground_truth)
        if is_compiled and not is_fused:
            # This would break the graph that holds the kernel.
            self._check(prediction, ground_truth)
        if points is None:
            points = self._points_for(prediction[0], is_compiled, seed) if is_fused else self._endpoints(seed)
        if self.straight_through:
            prediction = straight_through(prediction, self.convention)
        if is_fused:
            return _fused.fused_loss(points, self.convention, prediction, ground_truth)
        if torch.is_grad_enabled() and not is_compiled:
            return _MeanLoss.apply(points, self.convention, *prediction, *ground_truth)
        return _losses(prediction, ground_truth, points, self.convention).mean()

    @outside_of_graph
    def _check(self, prediction: Maps, ground_truth: Maps) -> None:
        check_shapes(prediction=prediction, ground_truth=ground_truth)
        if self.check:
            check_values(prediction=prediction, ground_truth=ground_truth)
            self.check = False
        if not self._is_told and _fused.takes(prediction[0]):
            self._is_told = True
            if obstacle := _fused.obstacle(self.convention, ground_truth):
                told = f"RenderingLoss: without the fused kernel, many times slower: {obstacle}"
                warnings.warn(told, stacklevel=2)

    @outside_of_graph
    def _endpoints(self, seed: int | None) -> Tensor:
        if self._given is not None:
            return self._given.cpu()
        return _sampled(seed, self.near, self.distant, self.sampler, self.convention.name, False)

    def _points_for(self, map: Tensor, is_compiled: bool, seed: int | None) -> Tensor:
        """Endpoints of scenes in memory that the card of `map` copies without anybody waiting for it."""
        if self._given is not None:
            if not is_compiled:
                # On the card from the first call on.
                self._given = self._given.to(map.device)
            return self._given
        if is_compiled:
            return _sampled_in_graph(seed, self.near, self.distant, self.sampler, self.convention.name, map.is_cuda)
        if map.is_cuda and torch.cuda.is_current_stream_capturing():
            raise RuntimeError(
                "a CUDA graph repeats the scenes of its capture; give points=, a tensor on the card, and copy "
                "svbrdf.torch.endpoints(scenes) of new scenes into it before each replay"
            )
        return _sampled(seed, self.near, self.distant, self.sampler, self.convention.name, map.is_cuda)


def scene_losses(prediction: Maps, ground_truth: Maps, scenes: Sequence[Scene], convention: Convention) -> Tensor:
    """The loss of each scene and material: the number of scenes x the batch dimensions.

    Raises:
        ValueError: A map has another shape.
    """
    check_shapes(prediction=prediction, ground_truth=ground_truth)
    return _losses(prediction, ground_truth, endpoints(scenes), convention)


def render(maps: Maps, scene: Scene, convention: Convention) -> Tensor:
    """Algorithm 3: the radiance R, ... x 3 x H x W. Where the light is in or below the plane or the texel, R is 0.

    Raises:
        ValueError: A map has another shape.
    """
    check_shapes(maps=maps)
    of_material = terms(maps, working_type(maps), convention)
    of_scene = geometry(endpoints([scene])[0], of_material, convention)
    return torch.cat(radiance(of_material, of_scene, convention), dim=-3)


def straight_through(maps: Maps, convention: Convention) -> Maps:
    """The maps with diffuse and specular clamped to [0, 1], and roughness to 1 and the floor of the convention.

    The gradient is that of the clamped values, and passes to the values as they were: the gradient of `clamp` is 0
    beyond its limits, and no step would bring them back.
    """
    normal, *values = (map.to(working_type(maps)) for map in maps)
    limited = (map.detach().clamp(low, 1) for map, low in zip(values, (0, 0, convention.roughness_floor), strict=True))
    # The difference is 0.
    return Maps(normal, *(limit + (map - map.detach()) for limit, map in zip(limited, values, strict=True)))


def check_scenes(scenes: Sequence[Scene]) -> None:
    """Whether a loss over the scenes means anything: there is one, and no light or view in or below the plane."""
    if not scenes:
        raise ValueError("scenes: expected at least one, found none")
    for index, (_, view, light) in enumerate(scenes):
        for what, point in (("view", view), ("light", light)):
            if not point[2] > 0:
                raise ValueError(f"scenes: scene {index}: its {what} {point} is not above the plane of the material")


class _MeanLoss(torch.autograd.Function):
    """The mean of `_losses`. The gradient of each scene is added up while the loss is computed.

    The graph of one scene exists at a time. All scenes have the same weight in the mean, so that the gradient is known
    up to one factor, which `backward` gets.
    """

    @staticmethod
    def forward(ctx: Any, points: Tensor, convention: Convention, *maps: Tensor) -> Tensor:
        wanted = ctx.needs_input_grad[2:]
        leaves = _leaves(maps, wanted)
        prediction, ground_truth = Maps(*leaves[:4]), Maps(*leaves[4:])
        dtype = working_type(prediction, ground_truth)
        with torch.enable_grad():
            tensors = [*terms(prediction, dtype, convention), *terms(ground_truth, dtype, convention)]
        inner = _leaves(tensors, [tensor.requires_grad for tensor in tensors])
        pair = Terms(*inner[: len(inner) // 2]), Terms(*inner[len(inner) // 2 :])
        total = torch.zeros((), dtype=dtype, device=maps[0].device)
        for row in points:
            with torch.enable_grad():
                loss = _loss_of_scene(*pair, row, convention).mean() / len(points)
            if any(wanted):
                loss.backward()
            total += loss.detach()
        if any(wanted):
            # The Smith renderer does not use all terms.
            outer = [(tensor, leaf.grad) for tensor, leaf in zip(tensors, inner, strict=True) if leaf.grad is not None]
            torch.autograd.backward([tensor for tensor, _ in outer], [gradient for _, gradient in outer])
            ctx.save_for_backward(*(leaf.grad for leaf in leaves if leaf.requires_grad))
        return total

    @staticmethod
    def backward(ctx: Any, factor: Tensor) -> tuple[Tensor | None, ...]:
        gradients = iter(_fused.first_derivatives(factor, ctx.saved_tensors))
        return tuple(next(gradients) if wanted else None for wanted in ctx.needs_input_grad)


def _leaves(tensors: Sequence[Tensor], wanted: Sequence[bool]) -> list[Tensor]:
    return [tensor.detach().requires_grad_(want) for tensor, want in zip(tensors, wanted, strict=True)]


def _losses(prediction: Maps, ground_truth: Maps, points: Tensor, convention: Convention) -> Tensor:
    """The loss of each scene and material, for the endpoints of the scenes."""
    dtype = working_type(prediction, ground_truth)
    got, expected = (terms(maps, dtype, convention) for maps in (prediction, ground_truth))
    if not is_compiling():
        return torch.stack([_loss_of_scene(got, expected, row, convention) for row in points])
    # All scenes at once, as one more dimension in front of those of the batch: the compiler makes one loop of it. It
    # would compute the planes for each channel anew, so that channels are apart.
    dims = max(map.dim() for map in (*prediction, *ground_truth))
    rows = points.reshape(len(points), *[1] * (dims - 3), points.shape[-1])
    return _loss_of_scene(got, expected, rows, convention, apart=True)


def _loss_of_scene(got: "Terms", expected: "Terms", row: Tensor, convention: Convention, apart: bool = False) -> Tensor:
    of_scene = geometry(row, got, convention)
    both = (radiance(of_material, of_scene, convention, apart) for of_material in (got, expected))
    losses = [difference(a, b, convention).mean(dim=(-3, -2, -1)) for a, b in zip(*both, strict=True)]
    return torch.stack(losses).mean(dim=0)


def difference(a: Tensor, b: Tensor, convention: Convention) -> Tensor:
    """The difference of radiances whose mean is the loss."""
    if convention.norm == "mse":
        return (a - b).square()
    return (torch.log(a + convention.epsilon) - torch.log(b + convention.epsilon)).abs()


class Terms(NamedTuple):
    """What the radiance of a material needs in every scene. Planes, but for the two of RGB."""

    x: Tensor
    y: Tensor
    z: Tensor
    """The unit normal."""
    k: Tensor
    """k of the geometry term: half the GGX width."""
    k_left: Tensor
    """1 - k."""
    d_root: Tensor
    """The root of the numerator of D / 4: a / sqrt(4 pi)."""
    a2: Tensor
    """The square of the GGX width."""
    a2_left: Tensor
    """1 - a2."""
    lambert: Tensor
    """d (1 - s) / pi; d / pi where the Smith renderer does not weight it."""
    specular: Tensor


def terms(maps: Maps, dtype: torch.dtype, convention: Convention) -> Terms:
    """The terms of a material."""
    normal, diffuse, specular, roughness = (map.to(dtype) for map in maps)
    # The floor itself has a gradient, unlike that of `clamp`.
    rough = torch.where(roughness < convention.roughness_floor, convention.roughness_floor, roughness)
    a = rough * rough
    k, a2 = a * 0.5, a * a
    n = normalized(normal.split(1, dim=-3))
    if convention.smith and convention.smith.specular is not None:
        # With a gradient, which is 0.
        specular = convention.smith.specular + 0 * specular
    weighted = diffuse if convention.smith and not convention.smith.is_weighted else diffuse * (1 - specular)
    return Terms(*n, k, 1 - k, a * (4 * pi) ** -0.5, a2, 1 - a2, weighted * (1 / pi), specular)


class Geometry(NamedTuple):
    """What the radiance in a scene needs of it: planes, or single values where the scene is distant."""

    l: Vector
    """Unit vectors to the light."""
    v: Vector
    """Unit vectors to the view."""
    h: Vector
    """Unit half vectors; 0 where l = -v."""
    has_h: Tensor
    """1, and 0 where l = -v: the normal stands in for h there."""
    fresnel: Tensor
    """The power of the Fresnel term, in [0, 1]."""
    irradiance: Tensor
    """The factor on the reflectance and NoL: intensity / l.z, or over the square of the distance.

    0 where the light is in or below the plane.
    """


def geometry(row: Tensor, like: Terms, convention: Convention) -> Geometry:
    """The geometry of scenes for materials of the size, type and device of `like`, from ... x 7 endpoints."""
    n = like.x
    with torch.no_grad():
        x, y = positions(n.shape[-2], n.shape[-1])
        # A distant scene has single values, unless it is computed together with others.
        if row.dim() == 1 and row[0] == 0 and not convention.smith:
            x, y = x[:, :1], y[:1]
        is_near, *points = (value[..., None, None, None].to(n) for value in row.unbind(-1))
        # Light and view of the distant scenes of the Smith renderer are points, too.
        are_points = torch.ones_like(is_near) if convention.smith else is_near
        c_x, c_y = are_points * x.to(n), are_points * y.to(n)
        w_l, w_v = ((w[0] - c_x, w[1] - c_y, w[2]) for w in (points[:3], points[3:]))
        l, v = normalized(w_l), normalized(w_v)
        total = (l[0] + v[0], l[1] + v[1], l[2] + v[2])
        inverse, has_h = inverse_length(total)
        h = (total[0] * inverse, total[1] * inverse, total[2] * inverse)
        # Where l = -v and the texel is lit, VoH is NoV clamped at 0, as here.
        v_dot_h = dot(v, h).clamp(0, 1)
        if convention.smith:
            fresnel = (1 - v_dot_h.clamp(min=convention.smith.cosine_floor)) ** 5
            intensity = is_near * convention.intensity + (1 - is_near) * convention.smith.intensity_distant
            irradiance = (intensity / dot(w_l, w_l)).clamp(max=torch.finfo(n.dtype).max)
            return Geometry(l, v, h, has_h.to(n), fresnel, torch.where(l[2] > 0, irradiance, 0.0))
        fresnel = torch.exp2((-5.55473 * v_dot_h - 6.98316) * v_dot_h)
        l_z = l[2].clamp(min=max(convention.light_z_floor, torch.finfo(n.dtype).tiny))
        irradiance = (convention.intensity / l_z).clamp(max=torch.finfo(n.dtype).max)
        return Geometry(l, v, h, has_h.to(n), fresnel, torch.where(l[2] > 0, irradiance, 0.0))


def radiance(material: Terms, scene: Geometry, convention: Convention, apart: bool = False) -> list[Tensor]:
    """(F G D / 4 + d (1 - s) / pi) NoL / l.z times the intensity: RGB in one tensor, or in three where `apart`.

    In the Smith renderer, diffuse is weighted with (1 - s) (1 - w) = 1 - F, where it is.
    """
    n = (material.x, material.y, material.z)
    n_dot_l = dot(n, scene.l).clamp(min=0)
    n_dot_v = dot(n, scene.v).clamp(min=0)
    d_root = material.d_root / distribution_denominator(n, material, scene, convention)
    # Factors, not one quotient: in float32 its gradient overflows at roughness 0.
    g_l, g_v = (geometry_factor(cosine, material, convention) for cosine in (n_dot_l, n_dot_v))
    lobe = (d_root * d_root) * (g_l * g_v)
    e = n_dot_l * scene.irradiance
    # F = s + (1 - s) w is s (1 - w) + w.
    white = scene.fresnel * lobe
    coloured = lobe - white
    largest = torch.finfo(e.dtype).max
    share = 1 - scene.fresnel if convention.smith and convention.smith.is_weighted else None
    channels = [(material.lambert if share is None else material.lambert * share, material.specular)]
    if apart:
        channels = list(zip(*(rgb.split(1, dim=-3) for rgb in channels[0]), strict=True))
    return [
        (torch.addcmul(lambert + white, specular, coloured) * e).clamp(max=largest) for lambert, specular in channels
    ]


def distribution_denominator(n: Vector, material: Terms, scene: Geometry, convention: Convention) -> Tensor:
    """The denominator of the GGX distribution D = (a / denominator)^2 / pi, for the GGX width a.

    NoH^2 (a^2 - 1) + 1 cancels where NoH is near 1. With q = |n - h|^2, 1 - NoH^2 = q (1 - q / 4) does not.
    """
    apart = (n[0] - scene.h[0], n[1] - scene.h[1], n[2] - scene.h[2])
    q = dot(apart, apart)
    if convention.smith or convention.clamp_n_dot_h:
        # NoH = 1 - q / 2.
        q = q.clamp(max=2 - 2 * (convention.smith.cosine_floor if convention.smith else 0))
    sine2 = q * torch.addcmul(scene.has_h, q, scene.has_h, value=-0.25)
    denominator = torch.addcmul(material.a2, sine2, material.a2_left)
    return denominator.clamp(min=convention.d_floor) if convention.d_floor > 0 else denominator


def geometry_factor(cosine: Tensor, material: Terms, convention: Convention) -> Tensor:
    """One of the two factors of G, for NoL or NoV in [0, 1]."""
    if convention.smith:
        x = cosine.clamp(min=convention.smith.cosine_floor)
        return 2 / (x + torch.addcmul(material.a2, x * x, material.a2_left).sqrt())
    denominator = torch.addcmul(material.k, cosine, material.k_left)
    return 1 / (denominator.clamp(min=convention.g_floor) if convention.g_floor > 0 else denominator)


@outside_of_graph
def endpoints(scenes: Sequence[Scene]) -> Tensor:
    """Each scene as 7 numbers in float64: 1 if it is near, light, view.

    Distant directions get length 1 in float64, as in the core.
    """
    rows = []
    for kind, view, light in scenes:
        lengths = (1.0, 1.0) if kind == "near" else (hypot(*light), hypot(*view))
        values = [c / length for w, length in zip((light, view), lengths, strict=True) for c in w]
        rows.append([float(kind == "near"), *values])
    return torch.tensor(rows, dtype=torch.float64)


def _sampled(seed: int | None, near: int, distant: int, sampler: str, convention: str, is_pinned: bool) -> Tensor:
    """The endpoints of the scenes of a seed, or of a new one."""
    if seed is None:
        seed = int(torch.randint(2**63 - 1, (), device="cpu"))
    names: Any = {"sampler": sampler, "convention": convention}
    points = endpoints(sample_scenes(near, distant, seed=seed, **names))
    return points.pin_memory() if is_pinned else points


# On the processor, so that CUDA graphs of a compiler, which would repeat the scenes, leave it out.
_sampled_in_graph = _fused.operator(
    "svbrdf::sample_scenes",
    _sampled,
    lambda seed, near, distant, *_: torch.empty(near + distant, 7, dtype=torch.float64),
)


def positions(height: int, width: int) -> tuple[Tensor, Tensor]:
    """x, 1 x W, and y, H x 1, of the texels in the plane z = 0: the width spans [-1, 1], row 0 has the largest y."""
    scale = max(width - 1, 1)
    x = (2 * torch.arange(width, dtype=torch.float64) - (width - 1)) / scale
    y = ((height - 1) - 2 * torch.arange(height, dtype=torch.float64)) / scale
    return x[None, :], y[:, None]


def normalized(vector: Sequence[Tensor]) -> Vector:
    """The vector with length 1. One without length becomes (0, 0, 1)."""
    x, y, z = vector
    inverse, has_direction = inverse_length(vector)
    return x * inverse, y * inverse, torch.where(has_direction, z * inverse, 1.0)


def inverse_length(vector: Sequence[Tensor]) -> tuple[Tensor, Tensor]:
    """1 / length, and 0 where there is no length; and whether there is one."""
    squared = dot(vector, vector)
    has_direction = squared >= torch.finfo(squared.dtype).tiny
    # The inner `where`: dividing by 0 makes gradients NaN, which no mask removes.
    return torch.where(has_direction, 1 / torch.where(has_direction, squared, 1.0).sqrt(), 0.0), has_direction


def dot(a: Sequence[Tensor], b: Sequence[Tensor]) -> Tensor:
    """The dot product of vectors."""
    return torch.addcmul(torch.addcmul(a[0] * b[0], a[1], b[1]), a[2], b[2])

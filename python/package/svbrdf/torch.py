"""The rendering loss in PyTorch, for training.

One module in plain PyTorch, to be read and changed. It computes what the core computes: Algorithms 1 and 3 of
Deschaintre et al. (2018-2020) in each of the four conventions, in the scenes of the same seeds. In float64 it agrees
with the core within 1e-12, in float32 within 1e-5 (relative). No gradient is NaN: not at roughness 0, not at l = -v,
not on black texels.

    loss = svbrdf.torch.RenderingLoss()
    for step, (ground_truth, photo) in enumerate(batches):
        loss(network(photo), ground_truth, seed=step).backward()

Maps have channels first and any number of batch dimensions before them: normal, diffuse and specular ... x 3 x H x W,
roughness ... x 1 x H x W. Values are linear; colours and roughness lie in [0, 1]. Values are not checked.
"""

from collections.abc import Sequence
from math import pi
from typing import Literal, NamedTuple

import torch
from torch import Tensor

from ._scenes import CONVENTIONS, Convention, Scene, sample_scenes


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


class RenderingLoss(torch.nn.Module):
    """The rendering loss: the mean over scenes, texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|.

    Args:
        convention: A name of `svbrdf.CONVENTIONS`.
        near: The number of sampled near-field scenes.
        distant: The number of sampled distant scenes.
        sampler: "random" or "sobol".
        scenes: These scenes, in place of sampled ones.
    """

    def __init__(
        self,
        *,
        convention: str = "printed",
        near: int = 6,
        distant: int = 3,
        sampler: Literal["random", "sobol"] = "random",
        scenes: Sequence[Scene] | None = None,
    ) -> None:
        super().__init__()
        self.convention = CONVENTIONS[convention]
        self.near, self.distant = near, distant
        self.sampler: Literal["random", "sobol"] = sampler
        self.scenes = scenes

    def forward(self, prediction: Maps, ground_truth: Maps, *, seed: int = 0) -> Tensor:
        """The mean loss of a batch, over the scenes that `seed` names. A training run passes its step as the seed."""
        scenes = self.scenes
        if scenes is None:
            scenes = sample_scenes(
                self.near, self.distant, seed=seed, sampler=self.sampler, convention=self.convention.name
            )
        return scene_losses(prediction, ground_truth, scenes, self.convention).mean()


def scene_losses(prediction: Maps, ground_truth: Maps, scenes: Sequence[Scene], convention: Convention) -> Tensor:
    """The loss of each scene and material: the number of scenes x the batch dimensions."""
    epsilon = convention.epsilon

    def one(scene: Scene) -> Tensor:
        got = torch.log(render(prediction, scene, convention) + epsilon)
        expected = torch.log(render(ground_truth, scene, convention) + epsilon)
        return (got - expected).abs().mean(dim=(-3, -2, -1))

    return torch.stack([one(scene) for scene in scenes])


def render(maps: Maps, scene: Scene, convention: Convention) -> Tensor:
    """Algorithm 3: the radiance R, ... x 3 x H x W. Where the light is in or below the plane or the texel, R is 0."""
    n = normalized(maps.normal)
    l, v = (normalized(w) for w in directions(scene, n))
    n_dot_l = dot(n, l)
    l_z = l[2:3]
    is_lit = (n_dot_l > 0) & (l_z > 0)
    # Where there is no light, 1: dividing by 0 makes gradients NaN, which no mask removes.
    e = n_dot_l.clamp(min=0) / torch.where(l_z > 0, l_z, 1.0).clamp(min=convention.light_z_floor) * convention.intensity
    radiance = reflectance(maps._replace(normal=n), l, v, convention) * e
    largest = torch.finfo(radiance.dtype).max
    return torch.where(is_lit, radiance, 0.0).clamp(max=largest)


def reflectance(maps: Maps, l: Tensor, v: Tensor, convention: Convention) -> Tensor:
    """F G D / 4 + d (1 - s) / pi, for unit normals, unit l and unit v."""
    n, diffuse, specular, roughness = maps
    h = half_vector(n, l, v)
    n_dot_l = dot(n, l).clamp(min=0)
    n_dot_v = dot(n, v).clamp(min=0)
    v_dot_h = dot(v, h).clamp(0, 1)
    rough = roughness.clamp(min=convention.roughness_floor)
    a = rough * rough
    k = a * 0.5
    d = distribution(n, h, a, convention)
    g = geometry_factor(n_dot_l, k, convention) * geometry_factor(n_dot_v, k, convention)
    f = specular + (1 - specular) * torch.exp2((-5.55473 * v_dot_h - 6.98316) * v_dot_h)
    return f * (g * d * 0.25) + diffuse * (1 - specular) * (1 / pi)


def distribution(n: Tensor, h: Tensor, a: Tensor, convention: Convention) -> Tensor:
    """The GGX distribution D for the GGX width a.

    Its denominator NoH^2 (a^2 - 1) + 1 cancels where NoH is near 1. By Lagrange's identity 1 - NoH^2 = |n x h|^2 it is
    a sum of squares, which does not.
    """
    n_dot_h = dot(n, h)
    across = torch.linalg.cross(*torch.broadcast_tensors(n, h), dim=-3)
    denominator = dot(across, across) + (a * a) * (n_dot_h * n_dot_h)
    if convention.clamp_n_dot_h:
        denominator = torch.where(n_dot_h < 0, torch.ones_like(denominator), denominator)
    ratio = a / denominator.clamp(min=convention.d_floor)
    return (ratio * ratio) * (1 / pi)


def geometry_factor(cosine: Tensor, k: Tensor, convention: Convention) -> Tensor:
    """One of the two factors of G, for NoL or NoV in [0, 1]."""
    return 1 / (cosine * (1 - k) + k).clamp(min=convention.g_floor)


def half_vector(n: Tensor, l: Tensor, v: Tensor) -> Tensor:
    """The half vector of unit l and v; the normal where l = -v."""
    total = l + v
    squared = dot(total, total)
    has_direction = squared >= torch.finfo(squared.dtype).tiny
    return torch.where(has_direction, total / torch.where(has_direction, squared, 1.0).sqrt(), n)


def directions(scene: Scene, like: Tensor) -> tuple[Tensor, Tensor]:
    """The vectors from each texel to the light and to the view, 3 x H x W or 3 x 1 x 1, on the device of `like`.

    Distant directions get length 1 in float64, as in the core.
    """
    light, view = (torch.tensor(p, dtype=torch.float64) for p in (scene.light, scene.view))
    if scene.kind == "distant":
        light, view = light / light.norm(), view / view.norm()
        return light.to(like)[:, None, None], view.to(like)[:, None, None]
    c = positions(like.shape[-2], like.shape[-1]).to(like)
    return light.to(like)[:, None, None] - c, view.to(like)[:, None, None] - c


def positions(height: int, width: int) -> Tensor:
    """The position of each texel in the plane z = 0, 3 x H x W: the width spans [-1, 1], row 0 has the largest y."""
    scale = max(width - 1, 1)
    x = (2 * torch.arange(width, dtype=torch.float64) - (width - 1)) / scale
    y = ((height - 1) - 2 * torch.arange(height, dtype=torch.float64)) / scale
    return torch.stack([x.expand(height, width), y[:, None].expand(height, width), torch.zeros(height, width)])


def normalized(x: Tensor) -> Tensor:
    """Vectors of length 1 along dimension -3. One without length becomes (0, 0, 1)."""
    squared = dot(x, x)
    has_direction = squared >= torch.finfo(x.dtype).tiny
    up = torch.tensor([0.0, 0.0, 1.0]).to(x)[:, None, None]
    return torch.where(has_direction, x / torch.where(has_direction, squared, 1.0).sqrt(), up)


def dot(a: Tensor, b: Tensor) -> Tensor:
    """The dot product along dimension -3, which stays."""
    return (a * b).sum(dim=-3, keepdim=True)

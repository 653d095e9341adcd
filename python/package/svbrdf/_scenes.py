"""Scenes, conventions, and renderings of a material."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from numpy.typing import NDArray

from . import _core
from ._material import Material, Source, opened

SetName = Literal["flash", "flash-9", "hemisphere"]


class Scene(NamedTuple):
    """One view and one light.

    Coordinates are in units of half the width of the material, which lies in the plane z = 0 with z up.
    """

    kind: Literal["near", "distant"]
    """Whether view and light are positions ("near") or directions of any length ("distant")."""
    view: tuple[float, float, float]
    light: tuple[float, float, float]


@dataclass(frozen=True)
class Smith:
    """A renderer in the place of Algorithm 3.

    Exact separable Smith shadowing, Schlick's fifth power, and a light that falls off with the square of the distance,
    also in distant scenes, whose light and view are points at distance 1. Nothing is divided by l.z.
    """

    cosine_floor: float
    """Smallest n.l, n.v, n.h and v.h of the specular term."""
    intensity_distant: float
    """Intensity in distant scenes."""
    specular: float | None
    """The specular reflectance of every texel; None: that of the map."""
    is_weighted: bool
    """Whether diffuse is weighted with 1 - F."""


@dataclass(frozen=True)
class Convention:
    """The numbers in which the published variants of the rendering loss differ. A limit of 0 is no limit."""

    name: str
    intensity: float
    """Factor on the rendered radiance R."""
    roughness_floor: float
    """Smallest roughness that is rendered."""
    light_z_floor: float
    """Smallest l.z that R is divided by."""
    clamp_n_dot_h: bool
    """Whether NoH is clamped at 0 from below in D."""
    d_floor: float
    """Smallest denominator of D."""
    g_floor: float
    """Smallest denominator of either factor of G."""
    epsilon: float
    """Epsilon in the logarithms of the loss."""
    light_distance_sigma: float
    """Standard deviation of the logarithm of the distance of a near-field light."""
    u1_max: float
    """Upper end of u1 in Algorithm 2."""
    shift_z: float
    """Height of the random shift of near-field scenes."""
    norm: Literal["log-l1", "mse"] = "log-l1"
    """How renderings are compared."""
    smith: Smith | None = None
    """The renderer, where it is not Algorithm 3."""


def _convention(items: dict[str, Any]) -> Convention:
    smith = items.pop("smith")
    return Convention(**items, smith=smith and Smith(**smith))


CONVENTIONS = {items["name"]: _convention(items) for items in _core.conventions()}
"""The conventions that `svbrdf.torch` has, by their names; "printed" is the default. `svbrdf.loss` takes more."""


def scene_from(values: dict[str, Any]) -> Scene:
    """A scene of the JSON."""
    return Scene(values["kind"], tuple(values["view"]), tuple(values["light"]))


def _scenes(found: Sequence[tuple[Any, Any, Any]]) -> list[Scene]:
    return [Scene(kind, tuple(view), tuple(light)) for kind, view, light in found]


def sample_scenes(
    near: int = 6,
    distant: int = 3,
    *,
    seed: int = 0,
    sampler: Literal["random", "sobol"] = "random",
    convention: str = "printed",
) -> list[Scene]:
    """The scenes of a seed: near-field ones, then distant ones.

    The i-th scene of a kind depends on the seed, the sampler, the convention and i only.

    >>> [scene.kind for scene in sample_scenes(near=2, distant=1, seed=7)]
    ['near', 'near', 'distant']

    Raises:
        OverflowError, TypeError: A number or the seed is negative, or not whole.
        svbrdf.Error: There is no such sampler or convention, no scene, or more than 10,000,000.
    """
    return _scenes(_core.sample_scenes(near, distant, seed, sampler, convention))


def named_scenes(name: SetName, *, fov: float | None = None) -> list[Scene]:
    """The scenes of a set with a name, for every argument `scenes`.

    "flash" is one flash at the camera, straight above the centre; "flash-9" the nine flashes at the camera of
    MaterialGAN (Guo et al. 2020); "hemisphere" the 128 lights on the hemisphere of MatFusion (Sartor and Peers 2023),
    with the camera above the centre. `sample_scenes` has those of the papers (Algorithms 1 and 2).

    >>> [len(named_scenes(name)) for name in ("flash", "flash-9", "hemisphere")]
    [1, 9, 128]

    Args:
        name: The name of the set.
        fov: The angle in degrees that the width of the material spans at the camera of "flash"; 45 by default.

    Raises:
        ValueError: A field of view is given for a set that has none.
        svbrdf.Error: There is no such set, or the field of view is not between 0.1 and 179 degrees.
    """
    if fov is not None and name != "flash":
        raise ValueError(f"fov: a field of view belongs to 'flash', found {name!r}")
    return _scenes(_core.named_scenes(name, fov))


def read_scenes(path: str | os.PathLike[str]) -> list[Scene]:
    """The scenes of a scene file: `{"scenes": [{"kind": "near", "view": [x, y, z], "light": [x, y, z]}, ...]}`.

    Raises:
        OSError: The file cannot be read.
        svbrdf.Error: It has another form, or a scene that cannot be rendered.
    """
    return _scenes(_core.read_scenes(path))


def render(material: Material | Source, scene: Scene, *, convention: str = "printed") -> NDArray[Any]:
    """Renders a material in one scene (Algorithm 3).

    >>> import svbrdf
    >>> scene = svbrdf.Scene("near", view=(0, 0, 2.5), light=(0.4, 0.5, 1.2))
    >>> svbrdf.render(svbrdf.built_in()[0], scene).shape
    (256, 256, 3)

    Args:
        material: A material, or the path of one.
        scene: Positions or directions of view and light, above the plane of the material.
        convention: A name of `svbrdf.CONVENTIONS`.

    Returns:
        Linear radiance, height x width x 3, in the precision of the material.

    Raises:
        svbrdf.Error: The scene cannot be rendered, or the material cannot be read.
    """
    return _core.render(opened(material)._core, tuple(scene), convention)

"""Materials: from arrays and from files."""

import json
import os
import warnings
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, TypedDict, Unpack

from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Precision, as_array, looks_unsigned
from ._progress import Report, reported

Source = str | os.PathLike[str]
Encoding = Literal["linear", "srgb", "gamma2.2", "log0.01"]


class AssumptionWarning(UserWarning):
    """Something about a file or an array was assumed, and another reading is as plausible."""


class Assumption(NamedTuple):
    """One thing that reading a material assumed."""

    what: str
    """What it is about, such as "albedo" or "normal y"."""
    chosen: str
    why: str
    certainty: str
    """"given", "sure", "likely" or "unsure"."""


def _warn_unsure(name: str, assumptions: Sequence[Assumption]) -> None:
    """Warns the caller of a function of the package of what is unsure about a material."""
    for unsure in (a for a in assumptions if a.certainty == "unsure"):
        text = f"{name}: {unsure.what}: {unsure.chosen}: {unsure.why}"
        warnings.warn(text, AssumptionWarning, stacklevel=3)


class ReadOptions(TypedDict, total=False):
    """How the files of a material are read: the options of the command line; None is inferred from the files."""

    preset: str | None
    """Conventions of a source of materials, such as "deschaintre" or "polyhaven"."""
    albedo: Encoding | None
    """Encoding of diffuse, base colour and specular."""
    specular_albedo: Encoding | None
    """Encoding of specular where it differs."""
    normal_y: Literal["up", "down"] | None
    """Where the green of normal maps points."""
    normal_encoding: Literal["unsigned", "signed", "xy", "ag"] | None
    """How the components of normals are stored."""
    roughness: Literal["r", "gloss", "alpha", "axay", "gamma2.2"] | None
    """What roughness values mean."""
    workflow: Literal["specular", "metallic"] | None
    """Diffuse and specular, or base colour and metallic."""
    dielectric_f0: float | None
    """Reflectance of dielectrics where no map holds it, in [0, 1]."""
    energy: Literal["scaled", "unscaled"] | None
    """Whether the renderer that diffuse was made for scales it by (1 - specular)."""
    order: str | None
    """Order of the tiles of a packed image, a letter each, such as "ndrs"."""
    grid: str | None
    """How a packed image is divided, such as "4x1"."""
    exemplar: int | None
    """Which row of a packed image, or which material of several, from 0."""
    flip_v: bool | None
    """Whether row 0 of every picture is the lowest one."""
    non_finite: Literal["refuse", "replace"] | None
    """How NaN and infinity are treated."""


def options_json(given: Any) -> str:
    """`ReadOptions` as JSON for the core."""
    return json.dumps({name.replace("_", "-"): value for name, value in given.items()})


class Material:
    """An SVBRDF: normal, diffuse, specular and roughness of every texel.

    >>> import numpy as np
    >>> gray = np.full((4, 6, 3), 0.5, np.float32)
    >>> up = np.broadcast_to(np.float32([0, 0, 1]), (4, 6, 3))
    >>> Material(normal=up, diffuse=gray, specular=0.04 * gray, roughness=gray[..., 0], name="gray")
    <svbrdf.Material 'gray', 6 x 4 texels, f32>

    Args:
        normal: Height x width x 3. x right, y up, z out of the surface; of any length, normalized here. x and y are
            negative where a normal points left or down: give 2 n - 1 of normals n that are stored in [0, 1].
        diffuse: Height x width x 3. Linear RGB in [0, 1].
        specular: Height x width x 3. Reflectance at normal incidence, linear RGB in [0, 1].
        roughness: Height x width. In [0, 1]; the GGX width is its square.
        name: What reports call the material.
        precision: What the values are kept in: "f32" or "f64".

    Row 0 is the top row. Anything with `__array__` or `__dlpack__` in the memory of the CPU will do, such as a tensor
    of PyTorch. Arrays are read without a copy where they have numbers of the precision and are C-contiguous, or are
    3 x height x width in memory with the channels moved to the end; of others, numpy makes such a copy. The core
    keeps checked values and normalized normals in memory of its own: arrays can be changed afterwards.

    Warns:
        AssumptionWarning: No x or y of a normal is negative, and lengths are not 1.

    Raises:
        TypeError: A map is not an array of floating-point numbers.
        ValueError: A map has another shape, or masked texels.
        svbrdf.Error: A value is NaN, infinite or out of its range, or a normal has no length.
    """

    path: str | None = None
    """Where it was read from."""
    notes: tuple[str, ...] = ()
    """What reading it noticed."""
    assumptions: tuple[Assumption, ...] = ()
    """What reading it assumed."""
    _options: ReadOptions | None = None
    _files: tuple[Source, ...] = ()

    def __init__(
        self,
        *,
        normal: ArrayLike,
        diffuse: ArrayLike,
        specular: ArrayLike,
        roughness: ArrayLike,
        name: str | None = None,
        precision: Precision = "f32",
    ) -> None:
        colours = {"normal": normal, "diffuse": diffuse, "specular": specular}
        maps = {key: as_array(key, given, 3, precision) for key, given in colours.items()}
        maps["roughness"] = as_array("roughness", roughness, 1, precision)
        height, width = maps["roughness"].shape
        for key, array in maps.items():
            if array.shape[:2] != (height, width):
                raise ValueError(
                    f"{key}: expected the shape of roughness, {height} x {width}, "
                    f"found {array.shape[0]} x {array.shape[1]}; resize the maps to one shape"
                )
        arrays = {**maps, "name": name or "material", "size": (width, height)}
        self._core = _core.CoreMaterial(arrays, precision)
        self._is_named = name is not None
        if reason := looks_unsigned(maps["normal"]):
            why = f"{reason}; give 2 n - 1 if they are stored as (n + 1) / 2"
            self.assumptions = (Assumption("normal encoding", "signed", why, "unsure"),)
            _warn_unsure(self.name, self.assumptions)

    @classmethod
    def _of(cls, core: _core.CoreMaterial) -> "Material":
        material = cls.__new__(cls)
        material._core, material._is_named = core, True
        return material

    @property
    def name(self) -> str:
        """What reports call it."""
        return self._core.name

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in texels."""
        return self._core.size

    @property
    def precision(self) -> Precision:
        """The precision of the values: "f32" or "f64"."""
        return self._core.precision

    @property
    def normal(self) -> NDArray[Any]:
        """Unit normals, height x width x 3: a copy."""
        return self._core.map("normal")

    @property
    def diffuse(self) -> NDArray[Any]:
        """Diffuse albedo, height x width x 3: a copy."""
        return self._core.map("diffuse")

    @property
    def specular(self) -> NDArray[Any]:
        """Reflectance at normal incidence, height x width x 3: a copy."""
        return self._core.map("specular")

    @property
    def roughness(self) -> NDArray[Any]:
        """Roughness, height x width: a copy."""
        return self._core.map("roughness")

    def __repr__(self) -> str:
        width, height = self.size
        return f"<svbrdf.Material {self.name!r}, {width} x {height} texels, {self.precision}>"


def read(
    path: Source,
    *,
    strict: bool = False,
    precision: Precision = "f32",
    progress: bool | Report = False,
    **options: Unpack[ReadOptions],
) -> Material:
    """Reads a material: a packed or layered image, a folder, or the common prefix of files.

    What was inferred from the files is in `Material.assumptions`; what is unsure is also a warning.

    Args:
        path: Of a file, a folder, or a name prefix.
        strict: Whether guesses are errors.
        precision: "f32" or "f64".
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).
        **options: Those of `svbrdf.ReadOptions`, such as `albedo="srgb"`.

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A file is broken or not a material, or there is no such option or value.
    """
    with reported(f"reading {os.fspath(path)}", progress) as report:
        found = _core.read(path, options_json(options), precision, strict, report)
    material = Material._of(found["material"])
    material.path = os.fspath(path)
    material._options = options
    material._files = tuple(found["files"])
    material.notes = tuple(found["notes"])
    material.assumptions = tuple(Assumption(*fields) for fields in found["assumptions"])
    _warn_unsure(material.name, material.assumptions)
    return material


def write(
    material: "Material | Source",
    path: Source,
    *,
    depth: Literal["8", "16", "half", "float"] | None = None,
) -> str | None:
    """Writes a material by the extension of `path`: layered EXR, packed PNG, glTF, or a folder of PNG files.

    The file or folder appears when it is complete, or not at all. The files that the material was read from are not
    replaced.

    Args:
        material: A material, or the path of one.
        path: Ends with .exr, .png or .glb, or names a folder that is empty or does not exist.
        depth: Bits of a PNG ("8", "16") or numbers of an EXR ("half", "float").

    Returns:
        A note where some programs show less than the file has.

    Raises:
        OSError: The file cannot be written.
        svbrdf.Error: The kind of file does not have this depth, or `path` is a file that the material was
            read from.
    """
    material = opened(material)
    return _core.write(material._core, path, material._files, depth)


def built_in(*, precision: Precision = "f32") -> list[Material]:
    """The built-in materials: a ground truth, then two predictions of it, of 256 x 256 texels.

    >>> [material.name for material in built_in()]
    ['worn tiles', 'blurred normals', 'wrong roughness']
    """
    return [Material._of(core) for core in _core.built_in(precision)]


def opened(material: "Material | Source", precision: Precision = "f32") -> Material:
    """The material, read where a path was given."""
    if isinstance(material, Material):
        return material
    if isinstance(material, str | os.PathLike):
        return read(material, precision=precision)
    raise TypeError(
        f"expected a svbrdf.Material or the path of one, found {type(material).__name__}; "
        "give arrays as svbrdf.Material(normal=, diffuse=, specular=, roughness=)"
    )

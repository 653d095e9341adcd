"""Materials: from arrays and from files."""

import json
import os
from typing import Any, Literal

from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Precision, as_array, from_bytes
from ._assumptions import Assumption, warn_unsure
from ._normals import NormalEncoding, as_normals, looks_unsigned
from ._progress import Report, reported
from ._text import escaped

Source = str | os.PathLike[str]


class Material:
    """An SVBRDF: normal, diffuse, specular and roughness of every texel.

    >>> import numpy as np
    >>> gray = np.full((4, 6, 3), 0.5, np.float32)
    >>> up = np.broadcast_to(np.float32([0, 0, 1]), (4, 6, 3))
    >>> Material(normal=up, diffuse=gray, specular=0.04 * gray, roughness=gray[..., 0], name="gray")
    <svbrdf.Material 'gray', 6 x 4 texels, f32>

    Args:
        normal: Height x width x 3. x right, y up, z out of the surface; of any length, normalized here. x and y are
            negative where a normal points left or down: normals that are stored in [0, 1] take a `normal_encoding`.
        diffuse: Height x width x 3. Linear RGB in [0, 1].
        specular: Height x width x 3. Reflectance at normal incidence, linear RGB in [0, 1].
        roughness: Height x width. In [0, 1]; the GGX width is its square.
        name: What reports call the material.
        precision: What the values are kept in: "f32" or "f64".
        normal_encoding: How the components of normals are stored, in the words of `svbrdf.read`: "signed", as they are;
            "unsigned", as (n + 1) / 2; "xy", x and y as (n + 1) / 2 in 2 or 3 channels, of which a third is not read;
            "ag", x in the fourth of 4 channels, y in the second. None: signed, with a warning where no x or y is
            negative and lengths are not 1.

    Row 0 is the top row. Anything with `__array__` or `__dlpack__` in the memory of the CPU will do, such as a tensor
    of PyTorch. Arrays are read without a copy where they have numbers of the precision and are C-contiguous, or are
    3 x height x width in memory with the channels moved to the end; of others, numpy makes such a copy. The core
    keeps checked values and normalized normals in memory of its own: arrays can be changed afterwards.

    Raises:
        TypeError: A map is not an array of floating-point numbers.
        ValueError: A map has another shape, or masked texels, or there is no such encoding.
        svbrdf.Error: A value is NaN, infinite or out of its range, or a normal has no length.

    Materials can be pickled, with what reading them found, and copied; a copy shares the values.
    """

    path: str | None = None
    """Where it was read from."""
    notes: tuple[str, ...] = ()
    """What reading it noticed."""
    assumptions: tuple[Assumption, ...] = ()
    """What reading it assumed."""
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
        normal_encoding: NormalEncoding | None = None,
    ) -> None:
        colours = {"diffuse": diffuse, "specular": specular}
        maps = {"normal": as_normals(normal, normal_encoding, precision)}
        maps |= {key: as_array(key, given, 3, precision) for key, given in colours.items()}
        values, _ = as_array("roughness", roughness, 1, precision)
        height, width = values.shape
        for key, (array, is_planar) in maps.items():
            shape = array.shape[1:] if is_planar else array.shape[:2]
            if shape != (height, width):
                raise ValueError(
                    f"{key}: expected the shape of roughness, {height} x {width}, found {shape[0]} x {shape[1]}; "
                    "resize the maps to one shape"
                )
        arrays: dict[str, object] = {key: array for key, (array, _) in maps.items()}
        arrays["roughness"] = values
        arrays["planar"] = [is_planar for _, is_planar in maps.values()]
        arrays["name"], arrays["size"] = name or "material", (width, height)
        self._core = _core.CoreMaterial.from_arrays(arrays, precision, None)
        self._is_named = name is not None
        if normal_encoding is None:
            self._check_signed(*maps["normal"])

    @classmethod
    def _of(cls, core: _core.CoreMaterial) -> "Material":
        material = cls.__new__(cls)
        material._core, material._is_named = core, True
        return material

    def _check_signed(self, normal: NDArray[Any], is_planar: bool) -> None:
        reason = looks_unsigned(normal.transpose(1, 2, 0) if is_planar else normal)
        if reason is not None:
            remedy = 'give normal_encoding="unsigned" if they are stored as (n + 1) / 2, else "signed"'
            self.assumptions = (Assumption("normal encoding", "signed", f"{reason}; {remedy}", "unsure"),)
            warn_unsure(self.name, self.assumptions, stacklevel=4)

    def __copy__(self) -> "Material":
        # The values never change.
        copy = object.__new__(type(self))
        copy.__dict__.update(self.__dict__)
        return copy

    def __deepcopy__(self, memo: object) -> "Material":
        return self.__copy__()

    def __reduce__(self) -> tuple[Any, ...]:
        others = {key: value for key, value in self.__dict__.items() if key != "_core"}
        arrays: dict[str, Any] = {name: self._map(name) for name in ("normal", "diffuse", "specular", "roughness")}
        arrays |= {"planar": [False] * 3, "name": self.name, "size": self.size}
        return _restored, (type(self), arrays, self.precision, self._core.storage, others)

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
        return self._map("normal")

    @property
    def diffuse(self) -> NDArray[Any]:
        """Diffuse albedo, height x width x 3: a copy."""
        return self._map("diffuse")

    @property
    def specular(self) -> NDArray[Any]:
        """Reflectance at normal incidence, height x width x 3: a copy."""
        return self._map("specular")

    @property
    def roughness(self) -> NDArray[Any]:
        """Roughness, height x width: a copy."""
        return self._map("roughness")

    def _map(self, name: str) -> NDArray[Any]:
        channels = 1 if name == "roughness" else 3
        return from_bytes(self._core.map(name), self.size, channels, self.precision)

    def __repr__(self) -> str:
        width, height = self.size
        return f"<svbrdf.Material {self.name!r}, {width} x {height} texels, {self.precision}>"

    def _repr_html_(self) -> str:
        width, height = self.size
        name = escaped(self.name)
        caption = f"{name}, {width} &times; {height} texels: rendering, normal, diffuse, specular, roughness"
        picture = f'<img src="{self._core.overview()}" alt="{name}" style="max-width: 100%">'
        return f'<figure style="margin: 0">{picture}<figcaption>{caption}</figcaption></figure>'


def read(
    path: Source,
    *,
    strict: bool = False,
    precision: Precision = "f32",
    progress: bool | Report = False,
    preset: str | None = None,
    albedo: Literal["linear", "srgb", "gamma2.2", "log0.01"] | None = None,
    specular_albedo: Literal["linear", "srgb", "gamma2.2", "log0.01"] | None = None,
    normal_y: Literal["up", "down"] | None = None,
    normal_encoding: NormalEncoding | None = None,
    roughness: Literal["r", "gloss", "alpha", "axay", "gamma2.2"] | None = None,
    workflow: Literal["specular", "metallic"] | None = None,
    dielectric_f0: float | None = None,
    energy: Literal["scaled", "unscaled"] | None = None,
    order: str | None = None,
    grid: str | None = None,
    exemplar: int | None = None,
    flip_v: bool | None = None,
    non_finite: Literal["refuse", "replace"] | None = None,
) -> Material:
    """Reads a material: a packed or layered image, a folder, or the common prefix of files.

    Options are those of the command line; `None`: inferred from the files. What was inferred is in
    `Material.assumptions`; what is unsure is also a warning.

    Args:
        path: Of a file, a folder, or a name prefix.
        strict: Whether guesses are errors.
        precision: "f32" or "f64".
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).
        preset: Conventions of a source of materials, such as "deschaintre" or "polyhaven".
        albedo: Encoding of diffuse, base colour and specular.
        specular_albedo: Encoding of specular where it differs.
        normal_y: Where the green of normal maps points.
        normal_encoding: How the components of normals are stored.
        roughness: What roughness values mean.
        workflow: Diffuse and specular, or base colour and metallic.
        dielectric_f0: Reflectance of dielectrics where no map holds it, in [0, 1].
        energy: Whether the renderer that diffuse was made for scales it by (1 - specular).
        order: Order of the tiles of a packed image, a letter each, such as "ndrs".
        grid: How a packed image is divided, such as "4x1".
        exemplar: Which row of a packed image, or which material of several, from 0.
        flip_v: Whether row 0 of every picture is the lowest one.
        non_finite: How NaN and infinity are treated.

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A file is broken or not a material, or an option has no such value.
    """
    options = {
        "preset": preset,
        "albedo": albedo,
        "specular-albedo": specular_albedo,
        "normal-y": normal_y,
        "normal-encoding": normal_encoding,
        "roughness": roughness,
        "workflow": workflow,
        "dielectric-f0": dielectric_f0,
        "energy": energy,
        "order": order,
        "grid": grid,
        "exemplar": exemplar,
        "flip-v": flip_v,
        "non-finite": non_finite,
    }
    with reported(f"reading {os.fspath(path)}", progress) as report:
        found = _core.read(path, json.dumps(options), precision, strict, report)
    material = Material._of(found["material"])
    material.path = os.fspath(path)
    material._files = tuple(found["files"])
    material.notes = tuple(found["notes"])
    material.assumptions = tuple(Assumption(*fields) for fields in found["assumptions"])
    warn_unsure(material.name, material.assumptions, stacklevel=3)
    return material


def _restored(
    kind: type[Material], arrays: dict[str, Any], precision: Precision, storage: str, others: dict[str, Any]
) -> Material:
    """The material of a pickle."""
    material = object.__new__(kind)
    material._core = _core.CoreMaterial.from_arrays(arrays, precision, storage)
    material.__dict__.update(others)
    return material


def write(
    material: "Material | Source",
    path: Source,
    *,
    depth: Literal["8", "16", "half", "float"] | None = None,
    preset: str | None = None,
    preview: bool = False,
) -> str | None:
    """Writes a material by the extension of `path`: layered EXR, packed PNG, glTF, MaterialX, or a folder of PNG files.

    The file or folder appears when it is complete, or not at all; a document of MaterialX after the folder of its
    pictures. The files that the material was read from are not replaced.

    Args:
        material: A material, or the path of one.
        path: Ends with .exr, .png, .glb or .mtlx, or names a folder that is empty or does not exist.
        depth: Bits of a PNG ("8", "16") or numbers of an EXR ("half", "float").
        preset: Whose names, order and encoding the files get.
        preview: Whether an EXR gets a rendering as its R, G and B.

    Returns:
        Of a form with base colour and metallic, how it expresses diffuse and specular, and what that changes.

    Raises:
        OSError: The file cannot be written.
        svbrdf.Error: The kind of file does not have this depth, preset or preview, or `path` is a file that the
            material was read from.
    """
    material = opened(material)
    return _core.write(material._core, path, material._files, depth, preset, preview)


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

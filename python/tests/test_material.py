"""Materials: arrays in, arrays out, files."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import maps
from svbrdf._arrays import as_array


def normalized(normal: Any) -> Any:
    return normal / np.linalg.norm(normal, axis=-1, keepdims=True)


@pytest.mark.parametrize("precision", ["f32", "f64"])
def test_arrays_come_back_as_they_went_in(precision: Any) -> None:
    given = maps(5, 7, dtype=np.float32 if precision == "f32" else np.float64)
    material = svbrdf.Material(**given, precision=precision)
    assert material.size == (7, 5)
    for name in ("diffuse", "specular", "roughness"):
        got = getattr(material, name)
        assert got.dtype == given[name].dtype
        np.testing.assert_array_equal(got, given[name])
    np.testing.assert_allclose(material.normal, normalized(given["normal"]), rtol=0, atol=2e-7)


def test_every_memory_layout_gives_the_same_material() -> None:
    given = maps(5, 7)
    expected = svbrdf.Material(**given)

    def unaligned(x: Any) -> Any:
        moved = np.frombuffer(b"-" + x.tobytes(), np.uint8)[1:].view(x.dtype).reshape(x.shape)
        assert not moved.flags.aligned
        return moved

    layouts: dict[str, Any] = {
        "planes": lambda x: np.ascontiguousarray(np.moveaxis(x, -1, 0)).transpose(1, 2, 0) if x.ndim == 3 else x,
        "columns first": np.asfortranarray,
        "every second row": lambda x: np.repeat(x, 2, axis=0)[::2],
        "mirrored twice": lambda x: np.flip(np.flip(x).copy()),
        "float64": lambda x: x.astype(np.float64),
        "read only": lambda x: np.broadcast_to(x, x.shape),
        "unaligned": unaligned,
        "bytes swapped": lambda x: x.astype(x.dtype.newbyteorder()),
        "lists": lambda x: x.astype(np.float64).tolist(),
    }
    for layout, convert in layouts.items():
        material = svbrdf.Material(**{name: convert(array) for name, array in given.items()})
        for name in given:
            np.testing.assert_array_equal(getattr(material, name), getattr(expected, name), layout)
    square = maps(3, 3)
    assert not np.array_equal(svbrdf.Material(**square).diffuse, square["diffuse"].transpose(1, 0, 2))


def test_arrays_are_read_without_a_copy() -> None:
    last = maps(4, 5)["diffuse"]
    first = np.ascontiguousarray(np.moveaxis(last, -1, 0)).transpose(1, 2, 0)
    for given in (last, first):
        assert np.shares_memory(as_array("diffuse", given, 3, "f32"), given)
        assert not np.shares_memory(as_array("diffuse", given, 3, "f64"), given)


def changed(map: str, at: Any, value: float, side: int = 5) -> dict[str, Any]:
    given = maps(4, side)[map]
    given[at] = value
    return {map: given}


GRAY = maps(4, 5)["diffuse"]
REFUSED: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"diffuse": np.zeros((4, 5), np.float32)}, ValueError, "diffuse: expected height x width x 3, found 4 x 5"),
    ({"normal": np.zeros((3, 4, 5))}, ValueError, "normal: .* found 3 x 4 x 5; move the channels to the end"),
    ({"roughness": np.zeros(4)}, ValueError, "roughness: expected height x width, found 4"),
    ({"specular": np.zeros((4, 4, 3))}, ValueError, "specular: expected the shape of roughness, 4 x 5, found 4 x 4"),
    ({"diffuse": np.zeros((4, 5, 3), np.uint8)}, TypeError, "diffuse: expected floating-point numbers, found uint8"),
    *[
        ({"roughness": np.zeros((4, 5), dtype)}, TypeError, "roughness: expected floating-point numbers, found")
        for dtype in ("?", "O", "c8", "S8", "m8[s]", "f4,f4")
    ],
    ({"normal": "gt.png"}, TypeError, "normal: expected floating-point numbers, found"),
    ({"roughness": 0.5}, ValueError, "roughness: expected height x width, found a number"),
    ({"diffuse": np.ma.masked_greater(GRAY, 0.5)}, ValueError, "diffuse: expected a value in every texel"),  # type: ignore[no-untyped-call]
    (changed("roughness", (2, 3), np.nan), svbrdf.Error, r"roughness map, column 3, row 2: .* in \[0, 1\], found NaN"),
    (changed("specular", (1, 0, 2), 1.5), svbrdf.Error, "specular map, column 0, row 1: .* found 1.5"),
    (changed("normal", (3, 4), 0), svbrdf.Error, "normal map, column 4, row 3: .* some length"),
    (maps(0, 0), svbrdf.Error, "material is not a material: expected at least one texel"),
]


@pytest.mark.parametrize(("given", "error", "match"), REFUSED)
def test_maps_are_checked_by_their_names(given: dict[str, Any], error: type[Exception], match: str) -> None:
    with pytest.raises(error, match=match):
        svbrdf.Material(**{**maps(4, 5), **given})


def test_a_material_survives_a_file_of_floats_bit_for_bit(tmp_path: Path) -> None:
    material = svbrdf.built_in()[0]
    svbrdf.write(material, tmp_path / "made.exr", depth="float")
    read = svbrdf.read(tmp_path / "made.exr", strict=True)
    for name in ("normal", "diffuse", "specular", "roughness"):
        np.testing.assert_array_equal(getattr(read, name), getattr(material, name))
    assert read.path == str(tmp_path / "made.exr")
    assert read.name == "made"


def test_reading_reports_what_it_assumed(tmp_path: Path) -> None:
    svbrdf.write(svbrdf.built_in()[0], tmp_path / "tiles.png")
    material = svbrdf.read(tmp_path / "tiles.png", normal_y="up")
    (given,) = (a for a in material.assumptions if a.what == "normal y")
    assert (given.chosen, given.certainty) == ("up", "given")
    folder = tmp_path / "unknown"
    folder.mkdir()
    for name in ("normal", "diffuse", "specular", "roughness"):
        values = getattr(material, name)
        np.save(folder / f"{name}.npy", values if name == "normal" else (255 * values).astype(np.uint8))
    with pytest.raises(svbrdf.Error, match=r"is ambiguous: .*; specify what is unsure, or allow guesses"):
        svbrdf.read(folder, strict=True)
    svbrdf.write(material, tmp_path / "own")
    assert svbrdf.read(tmp_path / "own", strict=True).name == "own"


def test_a_rendering_has_rows_columns_and_the_precision_of_its_material() -> None:
    scene = svbrdf.Scene("near", view=(0.1, 0.2, 2.5), light=(0.4, 0.5, 1.2))
    single = svbrdf.render(svbrdf.Material(**maps(9, 6)), scene)
    double = svbrdf.render(svbrdf.Material(**maps(9, 6), precision="f64"), scene)
    assert single.shape == (9, 6, 3)
    assert [single.dtype, double.dtype] == ["float32", "float64"]
    np.testing.assert_allclose(single, double, rtol=1e-4)
    assert not np.allclose(single[::-1], double, rtol=1e-4)
    # Light and view at y = -0.7 see the highlight of a plane below its middle.
    glossy: dict[str, Any] = {name: np.full((9, 6, 3), 0.5) for name in ("diffuse", "specular")}
    plane = {**glossy, "normal": np.broadcast_to((0, 0, 1.0), (9, 6, 3)), "roughness": np.full((9, 6), 0.2)}
    lit = svbrdf.render(svbrdf.Material(**plane), svbrdf.Scene("near", (0, -0.7, 2), (0, -0.7, 2)))
    assert lit.mean(axis=(1, 2)).argmax() == 6


def test_normals_that_look_stored_in_0_to_1_are_warned_of() -> None:
    built_in = svbrdf.built_in()[0]
    named = {name: getattr(built_in, name) for name in ("diffuse", "specular", "roughness")}
    stored = (built_in.normal + 1) / 2
    # A filter has overshot at a texel.
    overshot = stored.copy()
    overshot[0, 0, 0] = -0.01
    for normal in (stored, np.moveaxis(np.ascontiguousarray(np.moveaxis(stored, -1, 0)), 0, -1), overshot):
        told_of = r"(no|hardly any) x or y is negative, and lengths are .*2 n - 1"
        with pytest.warns(svbrdf.AssumptionWarning, match=told_of) as told:
            material = svbrdf.Material(**named, normal=normal)
        assert (len(told), told[0].filename) == (1, __file__)
        (assumption,) = material.assumptions
        assert (assumption.chosen, assumption.certainty) == ("signed", "unsure")
    # What is unit or points left somewhere is not. Warnings are errors here.
    flat, tilted = np.zeros((2, *stored.shape), np.float32)
    flat[..., 2], tilted[..., :] = 2.5, (0.6, 0, 0.8)
    for normal in (built_in.normal, 3 * built_in.normal, flat, tilted, 2 * stored - 1):
        assert svbrdf.Material(**named, normal=normal).assumptions == ()


def test_the_files_of_a_material_are_not_replaced(tmp_path: Path) -> None:
    svbrdf.write(svbrdf.built_in()[0], tmp_path / "tiles.png")
    (tmp_path / "hard.png").hardlink_to(tmp_path / "tiles.png")
    before = (tmp_path / "tiles.png").read_bytes()
    material = svbrdf.read(tmp_path / "tiles.png", normal_y="up")
    for path in (tmp_path / "tiles.png", str(tmp_path / "hard.png")):
        with pytest.raises(svbrdf.Error, match=r"cannot write .*\.png: it is the file .*tiles\.png, which"):
            svbrdf.write(material, path, depth="16")
    with pytest.raises(svbrdf.Error, match="which the result is made from; name another file"):
        svbrdf.write(str(tmp_path / "tiles.png"), tmp_path / "tiles.png")
    assert (tmp_path / "tiles.png").read_bytes() == before
    svbrdf.write(material, tmp_path / "other.png")
    assert (tmp_path / "other.png").exists()

"""Materials: arrays in, arrays out, files."""

import copy
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import maps


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
        "mirrored twice": lambda x: x[::-1].copy()[::-1],
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


READ = """
import sys
from pathlib import Path

import numpy as np
import svbrdf


def kilobytes(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name))


def maps(side):
    def colour():
        if sys.argv[1] == "channels last":
            return np.full((side, side, 3), 0.5, sys.argv[2])
        return np.full((3, side, side), 0.5, sys.argv[2]).transpose(1, 2, 0)

    roughness = np.full((side, side), 0.5, sys.argv[2])
    return {"normal": colour(), "diffuse": colour(), "specular": colour(), "roughness": roughness}


# What the first call of all needs, such as threads.
svbrdf.Material(**maps(1))
given = maps(2048)
before = kilobytes("VmRSS")
material = svbrdf.Material(**given)
print((kilobytes("VmHWM") - before) / (10 * 4 * 2048**2 / 1024))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="/proc tells the peak of memory on Linux only")
@pytest.mark.parametrize("layout", ["channels last", "channels first"])
def test_arrays_are_read_without_a_copy(layout: str) -> None:
    def memory(dtype: str) -> float:
        """The peak of memory while a material is made, in sizes of its maps."""
        command = [sys.executable, "-c", READ, layout, dtype]
        return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)

    assert memory("float32") == pytest.approx(1, abs=0.05)
    # What is measured is seen: numbers of another precision are converted.
    assert memory("float64") > 1.9


def test_shapes_types_and_values_are_checked_by_the_name_of_the_map() -> None:
    def refused(error: type[Exception], match: str, **changed: Any) -> None:
        with pytest.raises(error, match=match):
            svbrdf.Material(**{**maps(4, 5), **changed})

    refused(ValueError, "diffuse: expected height x width x 3, found 4 x 5", diffuse=np.zeros((4, 5), np.float32))
    refused(ValueError, "normal: .* found 3 x 4 x 5; move the channels to the end", normal=np.zeros((3, 4, 5)))
    refused(ValueError, "roughness: expected height x width, found 4", roughness=np.zeros(4))
    refused(ValueError, "specular: expected the shape of roughness, 4 x 5, found 4 x 4", specular=np.zeros((4, 4, 3)))
    refused(TypeError, "diffuse: expected floating-point numbers, found uint8", diffuse=np.zeros((4, 5, 3), np.uint8))
    refused(TypeError, "normal: expected floating-point numbers, found", normal="gt.png")
    refused(ValueError, "roughness: expected height x width, found a number", roughness=0.5)
    # Some versions of numpy have no types for it.
    ma: Any = np.ma
    masked = ma.MaskedArray(maps(4, 5)["diffuse"], mask=maps(4, 5)["diffuse"] > 0.5)
    refused(ValueError, "diffuse: expected a value in every texel, found masked ones", diffuse=masked)
    assert svbrdf.Material(**{**maps(4, 5), "diffuse": ma.MaskedArray(maps(4, 5)["diffuse"])}).size == (5, 4)
    nan, high, dark = maps(4, 5)["roughness"], maps(4, 5)["specular"], maps(4, 5)["normal"]
    nan[2, 3], high[1, 0, 2], dark[3, 4] = np.nan, 1.5, 0
    refused(
        svbrdf.Error,
        r"material: roughness map, column 3, row 2: expected a value in \[0, 1\], found NaN",
        roughness=nan,
    )
    refused(svbrdf.Error, "specular map, column 0, row 1: .* found 1.5", specular=high)
    refused(svbrdf.Error, "normal map, column 4, row 3: .* some length", normal=dark)
    large = maps(200, 200)
    large["diffuse"][170, 3, 1] = large["diffuse"][180, 2, 1] = -1
    refused(svbrdf.Error, "diffuse map, column 3, row 170: .* found -1", **large)
    refused(svbrdf.Error, "material is not a material: expected at least one texel", **maps(0, 0))


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
    svbrdf.write(svbrdf.built_in()[0], folder)
    (folder / "roughness.png").rename(folder / "gloss.png")
    with pytest.raises(svbrdf.Error, match=r"is ambiguous: .*; specify what is unsure, or allow guesses"):
        svbrdf.read(folder, strict=True)


def test_files_that_cannot_be_used_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="cannot read"):
        svbrdf.read(tmp_path / "nothing.png")
    (tmp_path / "bad.png").write_bytes(b"no picture")
    with pytest.raises(svbrdf.Error, match=r"cannot decode .*bad.png"):
        svbrdf.read(tmp_path / "bad.png")
    with pytest.raises(svbrdf.Error, match="unknown variant `blue`, expected one of `linear`, `srgb`"):
        svbrdf.read(tmp_path / "bad.png", albedo="blue")  # type: ignore[arg-type]
    with pytest.raises(svbrdf.Error, match=r"cannot be written: expected an \.exr, \.png, \.glb or \.mtlx file"):
        svbrdf.write(svbrdf.built_in()[0], tmp_path / "a.jpg")
    (tmp_path / "file").touch()
    with pytest.raises(OSError, match="cannot write"):
        svbrdf.write(svbrdf.built_in()[0], tmp_path / "file" / "a.exr")


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
    with pytest.warns(svbrdf.AssumptionWarning, match=r"normal encoding: signed: no x or y is negative") as told:
        material = svbrdf.Material(**named, normal=stored)
    assert len(told) == 1
    assert told[0].filename == __file__
    assert "lengths are" in str(told[0].message)
    assert 'normal_encoding="unsigned"' in str(told[0].message)
    (assumption,) = material.assumptions
    assert (assumption.chosen, assumption.certainty) == ("signed", "unsure")
    with pytest.warns(svbrdf.AssumptionWarning):
        svbrdf.Material(**named, normal=np.moveaxis(np.ascontiguousarray(np.moveaxis(stored, -1, 0)), 0, -1))
    # What is unit or points left somewhere is not, nor is what was said to be signed. Warnings are errors here.
    flat, tilted = np.zeros((2, *stored.shape), np.float32)
    flat[..., 2], tilted[..., :] = 2.5, (0.6, 0, 0.8)
    for normal in (built_in.normal, 3 * built_in.normal, flat, tilted):
        assert svbrdf.Material(**named, normal=normal).assumptions == ()
    assert svbrdf.Material(**named, normal=stored, normal_encoding="signed").assumptions == ()


def test_a_normal_encoding_is_that_of_the_reader(tmp_path: Path) -> None:
    built_in = svbrdf.built_in()[0]
    named = {name: getattr(built_in, name) for name in ("diffuse", "specular", "roughness")}
    stored = ((built_in.normal + 1) / 2).astype(np.float32)
    blue = np.concatenate([stored[..., :2], np.ones_like(stored[..., :1])], axis=-1)
    for name, array in {"normal": stored, **named}.items():
        np.save(tmp_path / f"{name}.npy", array)
    for encoding, normal in (("unsigned", stored), ("xy", blue)):
        np.save(tmp_path / "normal.npy", normal)
        read = svbrdf.read(tmp_path, normal_encoding=encoding, normal_y="up", albedo="linear", roughness="r")  # type: ignore[arg-type]
        material = svbrdf.Material(**named, normal=normal, normal_encoding=encoding)  # type: ignore[arg-type]
        np.testing.assert_array_equal(material.normal, read.normal)
        np.testing.assert_allclose(material.normal, built_in.normal, atol=1e-3)
    two = svbrdf.Material(**named, normal=blue[..., :2], normal_encoding="xy")
    np.testing.assert_array_equal(two.normal, svbrdf.Material(**named, normal=blue, normal_encoding="xy").normal)
    # x in alpha, y in green.
    swizzled = np.stack([blue[..., 2], stored[..., 1], blue[..., 2], stored[..., 0]], axis=-1)
    material = svbrdf.Material(**named, normal=swizzled, normal_encoding="ag")
    np.testing.assert_array_equal(material.normal, svbrdf.Material(**named, normal=blue, normal_encoding="xy").normal)
    with pytest.raises(ValueError, match="normal_encoding: expected one of unsigned, signed, xy, ag, found 'rgb'"):
        svbrdf.Material(**named, normal=stored, normal_encoding="rgb")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="normal: expected height x width x 4, found 256 x 256 x 3"):
        svbrdf.Material(**named, normal=stored, normal_encoding="ag")
    with pytest.raises(ValueError, match="normal: expected height x width x 2 or 3, found 256 x 256 x 4"):
        svbrdf.Material(**named, normal=swizzled, normal_encoding="xy")


@pytest.mark.parametrize("precision", ["f32", "f64"])
def test_a_material_can_be_pickled_and_copied(tmp_path: Path, precision: Any) -> None:
    ground_truth, prediction, _ = svbrdf.built_in(precision=precision)
    svbrdf.write(prediction, tmp_path / "tiles.png")
    read = svbrdf.read(tmp_path / "tiles.png", normal_y="up", precision=precision)
    report = svbrdf.loss(ground_truth, read, near=2, distant=1, precision=precision)
    for copied in (pickle.loads(pickle.dumps(read)), copy.copy(read), copy.deepcopy({"a": read})["a"]):
        for name in ("normal", "diffuse", "specular", "roughness"):
            np.testing.assert_array_equal(getattr(copied, name), getattr(read, name))
        for name in ("name", "path", "size", "precision", "notes", "assumptions"):
            assert getattr(copied, name) == getattr(read, name)
        assert repr(copied) == repr(read)
        again = svbrdf.loss(ground_truth, copied, near=2, distant=1, precision=precision)
        assert again.to_dict() == report.to_dict()
        # How its files store it decides what a diagnosis tries, and the loss that they cannot resolve.
        assert copied._core.storage == read._core.storage != svbrdf.Material(**maps(4, 5))._core.storage
        with pytest.raises(svbrdf.Error, match="which the result is made from"):
            svbrdf.write(copied, tmp_path / "tiles.png")
    unnamed = svbrdf.Material(**maps(4, 5))
    assert svbrdf.loss(pickle.loads(pickle.dumps(unnamed)), unnamed, near=1, distant=1).ground_truth == "ground truth"
    copied = copy.copy(read)
    copied.path = None
    assert read.path is not None


def test_the_files_of_a_material_are_not_replaced(tmp_path: Path) -> None:
    svbrdf.write(svbrdf.built_in()[0], tmp_path / "tiles.png")
    (tmp_path / "hard.png").hardlink_to(tmp_path / "tiles.png")
    before = (tmp_path / "tiles.png").read_bytes()
    material = svbrdf.read(tmp_path / "tiles.png", normal_y="up")
    for path in (tmp_path / "tiles.png", str(tmp_path / "hard.png")):
        with pytest.raises(svbrdf.Error, match=r"cannot write .*\.png: it is the file .*tiles\.png, which"):
            svbrdf.write(material, path, depth="16")
    with pytest.raises(svbrdf.Error, match="which the result is made from; name another file"):
        svbrdf.write(str(tmp_path / "tiles.png"), tmp_path / "tiles.png", preset="gao")
    assert (tmp_path / "tiles.png").read_bytes() == before
    svbrdf.write(material, tmp_path / "other.png")
    assert (tmp_path / "other.png").exists()

"""The rendering loss: paths and arrays, names, and what is refused."""

import json
import subprocess
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import maps


def of_program(program: str, *arguments: str) -> dict[str, Any]:
    command = [program, "loss", *arguments, "--format", "json"]
    report: dict[str, Any] = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return report


def test_paths_and_arrays_give_the_same_bits_as_the_command_line(program: str, tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("gt.exr", "a.exr", "b.exr")]
    materials = [svbrdf.Material(**maps(33, 47, seed), name=path.stem) for seed, path in enumerate(paths)]
    for material, path in zip(materials, paths, strict=True):
        svbrdf.write(material, path, depth="float")
    expected = [result["loss"] for result in of_program(program, *map(str, paths), "--near", "4")["results"]]
    from_paths = svbrdf.loss(paths[0], paths[1:], near=4)
    from_arrays = svbrdf.loss(materials[0], materials[1:], near=4)
    assert [result.loss for result in from_paths.results] == expected
    assert [result.loss for result in from_arrays.results] == expected
    assert from_paths.results[0].path == str(paths[1])
    # A thousandth of the roughness of one texel is seen; its last bit is not on every processor.
    other = maps(33, 47, 1)
    other["roughness"][0, 0] = np.float32(0.999) * other["roughness"][0, 0]
    assert svbrdf.loss(materials[0], svbrdf.Material(**other), near=4).results[0].loss != expected[0]


def test_unnamed_materials_are_numbered_and_alike_names_are_told_apart(tmp_path: Path) -> None:
    a, b = svbrdf.Material(**maps(4, 4, 1)), svbrdf.Material(**maps(4, 4, 2))
    report = svbrdf.loss(a, [a, b])
    assert report.ground_truth == "ground truth"
    assert [result.prediction for result in report.results] == ["prediction 1", "prediction 2"]
    assert report.results[0].loss == 0
    tiles = svbrdf.built_in()[0]
    for folder in ("x", "y"):
        (tmp_path / folder).mkdir()
        svbrdf.write(tiles, tmp_path / folder / "m.exr", depth="float")
    report = svbrdf.loss(tiles, [tmp_path / "x" / "m.exr", tmp_path / "y" / "m.exr"])
    assert [result.prediction for result in report.results] == ["x", "y"]
    # A folder, as on the command line.
    (tmp_path / "run").mkdir()
    svbrdf.write(tiles, tmp_path / "run" / "wood.exr", depth="float")
    report = svbrdf.loss(tiles, f"{tmp_path}/run/", near=2)
    assert [(result.prediction, result.path) for result in report.results] == [("wood", f"{tmp_path}/run/")]


SMALL = svbrdf.Material(**maps(4, 4))
REFUSED: list[tuple[Any, dict[str, Any], type[Exception], str]] = [
    (svbrdf.loss, {"predictions": []}, ValueError, "predictions: expected at least one"),
    (
        svbrdf.loss,
        {"predictions": [maps(4, 4)]},
        TypeError,
        "expected a svbrdf.Material or the path of one, found dict",
    ),
    (svbrdf.loss, {"predictions": "/nowhere/at/all.png"}, FileNotFoundError, "cannot read .*nowhere"),
    (svbrdf.loss, {"sampler": "random"}, svbrdf.Error, "not with sampler random; specify the number"),
    (svbrdf.loss, {"time_budget": 0}, svbrdf.Error, "time_budget: expected seconds above 0"),
    (svbrdf.loss, {"nera": 6}, TypeError, "unexpected keyword argument 'nera'"),
    (svbrdf.scenes, {"top": -1}, svbrdf.Error, "top: found integer `-1`"),
    (svbrdf.metrics, {"exposure": float("nan")}, ValueError, "not JSON compliant"),
    (svbrdf.blame, {"seed": -1}, svbrdf.Error, "seed: found integer `-1`"),
    *(
        (svbrdf.loss, {name: 1.5}, svbrdf.Error, f"{name}: found floating point")
        for name in ("near", "distant", "seed")
    ),
    *((svbrdf.blame, {"target_error": e}, svbrdf.Error, "target_error: ") for e in ("1%", [0.01], True, 1.5, 0.5)),
]


@pytest.mark.parametrize(("compute", "given", "error", "match"), REFUSED)
def test_arguments_are_checked_by_name(compute: Any, given: dict[str, Any], error: type[Exception], match: str) -> None:
    with pytest.raises(error, match=match):
        compute(SMALL, **{"predictions": SMALL, **given})


def test_scenes_are_those_of_the_sampler_and_numbers_may_be_those_of_numpy() -> None:
    report = svbrdf.loss(SMALL, SMALL, near=np.int64(8), distant=4, seed=3)  # type: ignore[arg-type]
    assert report.scenes == tuple(svbrdf.sample_scenes(8, 4, seed=3))
    with pytest.raises(TypeError, match="near"):
        svbrdf.sample_scenes(near=1.5)  # type: ignore[arg-type]


def test_a_target_that_is_not_reached_is_a_warning_as_on_the_command_line() -> None:
    truth = maps(8, 8)
    other = {**truth, "roughness": truth["roughness"] * np.float32(0.5)}
    ground_truth, prediction = svbrdf.Material(**truth), svbrdf.Material(**other, name="other")
    missed = r"other is known to \+-0.0\d+%, not to the target of \+-0.001%: 786432 scenes"
    with pytest.warns(UserWarning, match=missed) as found:
        report = svbrdf.loss(ground_truth, prediction, target_error=1e-5)
    assert found[0].filename == __file__
    assert report.target_reached is False
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert svbrdf.loss(ground_truth, prediction, target_error=0.1).target_reached


def test_a_mask_and_a_registration_are_parts_of_the_question() -> None:
    truth, ours = maps(24, 20, 1), maps(24, 20, 2)
    kept = np.zeros((24, 20), bool)
    kept[4:20, 4:16] = True
    other = {name: values.copy() for name, values in ours.items()}
    other["roughness"][~kept] = 0.9
    a, b, c = (svbrdf.Material(**one) for one in (truth, ours, other))
    losses = [svbrdf.loss(a, one, near=4, mask=kept).results[0].loss for one in (b, c)]
    assert losses[0] == losses[1] != svbrdf.loss(a, b, near=4).results[0].loss
    (values,) = svbrdf.map(a, b, near=4, mask=kept).maps
    assert np.isnan(values[~kept]).all()
    assert np.isfinite(values[kept]).all()
    part = svbrdf.Material(**{name: values[4:20, 4:16] for name, values in truth.items()})
    assert svbrdf.loss(a, part, near=4, register="centre-crop").results[0].loss == 0
    with pytest.warns(UserWarning, match="centre-crop of a ground truth of 20 x 24"):
        assert svbrdf.loss(a, part, near=4).results[0].loss == 0
    with pytest.raises(svbrdf.Error, match="mask: expected a texel"):
        svbrdf.loss(a, b, near=4, mask=np.zeros((24, 20), bool))
    with pytest.raises(ValueError, match=r"mask: expected the height x width .*, 24 x 20, found 20 x 24"):
        svbrdf.loss(a, b, near=4, mask=kept.T)
    with pytest.raises(TypeError, match="mask: expected booleans, found float64"):
        svbrdf.loss(a, b, near=4, mask=np.ones((24, 20)))

"""The rendering loss: the numbers of the core, and what is refused."""

import json
import subprocess
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import golden_materials, maps


def of_program(program: str, *arguments: str) -> dict[str, Any]:
    command = [program, "loss", *arguments, "--format", "json"]
    report: dict[str, Any] = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return report


@pytest.mark.parametrize(
    ("options", "arguments"),
    [
        ({"near": 6, "distant": 3, "seed": 7}, ["--near", "6", "--distant", "3", "--seed", "7"]),
        ({"near": 20, "distant": 12, "sampler": "sobol"}, ["--near", "20", "--distant", "12", "--sampler", "sobol"]),
        ({"near": 30, "distant": 30, "texels": 64}, ["--near", "30", "--distant", "30", "--texels", "64"]),
        (
            {"convention": "guided-2020", "seed": 1, "near": 6},
            ["--near", "6", "--seed", "1", "--convention", "guided-2020"],
        ),
        ({"precision": "f64", "near": 2, "distant": 1}, ["--near", "2", "--distant", "1", "--precision", "f64"]),
        ({"target_error": 0.03}, ["--target-error", "3%"]),
        ({}, []),
        ({"seed": 3, "convention": "guided-2020"}, ["--seed", "3", "--convention", "guided-2020"]),
    ],
)
def test_the_loss_is_that_of_the_command_line_bit_for_bit(
    program: str, options: dict[str, Any], arguments: list[str]
) -> None:
    expected = of_program(program, *arguments)
    ground_truth, *predictions = svbrdf.built_in(precision=options.get("precision", "f32"))
    got = json.loads(json.dumps(svbrdf.loss(ground_truth, predictions, **options).to_dict()))
    assert got == expected


def test_without_options_the_loss_is_over_all_scenes_with_that_over_few_scenes_beside_it() -> None:
    ground_truth, *predictions = svbrdf.built_in()
    report = svbrdf.loss(ground_truth, predictions, seed=2)
    many = svbrdf.loss(ground_truth, predictions, target_error=0.01, seed=2)
    few = svbrdf.loss(ground_truth, predictions, near=6, distant=3, seed=2)
    assert [result.loss for result in report.results] == [result.loss for result in many.results]
    assert [result.few_scenes_loss for result in report.results] == [result.loss for result in few.results]
    assert [result.few_scenes_losses for result in report.results] == [result.losses for result in few.results]
    assert report.target_reached
    assert report.few_scenes is not None
    assert (report.few_scenes.near, report.few_scenes.distant) == (6, 3)
    assert report.few_scenes.scenes == few.scenes
    assert report.few_scenes.differences == few.differences
    assert few.few_scenes is None
    assert few.results[0].few_scenes_loss is None


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


def test_the_golden_losses_are_met_in_either_precision(golden: Path) -> None:
    worst: dict[Any, float] = {"f32": 0.0, "f64": 0.0}
    for path in sorted((golden / "loss").glob("*.json")):
        case = json.loads(path.read_text())
        scenes = svbrdf.read_scenes(golden / "scenes" / path.name)
        for precision in worst:
            materials = golden_materials(golden, case, precision)
            for convention, expected in case["expected"].items():
                report = svbrdf.loss(*materials, scenes=scenes, convention=convention, precision=precision)
                error = abs(report.results[0].loss - expected["loss"]) / max(expected["loss"], 1e-30)
                worst[precision] = max(worst[precision], error)
    assert 0 < worst["f64"] < 1e-9, worst
    assert 0 < worst["f32"] < 2e-5, worst


def test_a_report_has_losses_intervals_and_differences() -> None:
    ground_truth, *predictions = svbrdf.built_in()
    report = svbrdf.loss(ground_truth, predictions, near=8, distant=4, seed=3)
    first, second = report.results
    assert first.losses is not None
    assert second.losses is not None
    assert report.scenes is not None
    assert len(first.losses) == len(report.scenes) == 12
    assert first.interval95 is not None
    assert first.interval95[0] < first.loss < first.interval95[1]
    assert np.isclose(np.mean(first.losses), first.loss, rtol=1e-14)
    (difference,) = report.differences
    assert (difference.prediction, difference.to) == ("wrong roughness", "blurred normals")
    assert difference.difference == pytest.approx(second.loss - first.loss, abs=1e-12)
    assert report.scenes == tuple(svbrdf.sample_scenes(8, 4, seed=3))


def test_the_blame_adds_up(program: str) -> None:
    ground_truth, *predictions = svbrdf.built_in()
    report = svbrdf.blame(ground_truth, predictions, target_error=0.05)
    for attribution in report.attributions:
        total = sum(share.shapley.mean for share in attribution.maps)
        assert total == pytest.approx(attribution.loss.mean, rel=1e-12)
    assert svbrdf.blame(ground_truth, predictions[0], target_error=0.05).attributions == report.attributions[:1]


def test_a_ranking_is_by_loss_in_groups_that_the_data_separate() -> None:
    ground_truth, blurred, rough = svbrdf.built_in()
    report = svbrdf.rank(ground_truth, [blurred, rough, blurred], target_error=0.05)
    assert [place.index for place in report.ranking] == [1, 0, 2]
    assert [place.group for place in report.ranking] == [1, 2, 2]
    best, second, _ = report.ranking
    assert best.to_best is None
    assert second.to_best is not None
    assert second.to_best.mean == pytest.approx(second.loss.mean - best.loss.mean, rel=1e-9)


def test_listed_scenes_give_the_losses_of_the_sampled_ones() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    sampled = svbrdf.loss(ground_truth, prediction, near=6, distant=3, seed=5)
    listed = svbrdf.loss(ground_truth, prediction, scenes=sampled.scenes)
    assert listed.results[0].losses == sampled.results[0].losses
    assert listed.seed is None


def test_a_target_error_is_reached_and_reproduced_by_its_counts() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    report = svbrdf.loss(ground_truth, prediction, target_error=0.02)
    assert report.target_reached
    assert report.scenes is None
    again = svbrdf.loss(
        ground_truth, prediction, near=report.near, distant=report.distant, sampler="sobol", texels=report.texels
    )
    assert again.results[0].loss == report.results[0].loss


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
    assert [result.prediction for result in report.results] == ["x/m.exr", "y/m.exr"]


def test_what_cannot_be_compared_is_refused_with_the_text_of_the_core() -> None:
    small, large = svbrdf.Material(**maps(4, 4)), svbrdf.Material(**maps(4, 5))
    with pytest.raises(svbrdf.Error, match=r"sizes differ: .* 4 x 4, .* 5 x 4; resize them to one size"):
        svbrdf.loss(small, large)
    with pytest.raises(svbrdf.Error, match="unknown convention `none`; use one of: printed, single-image-2018"):
        svbrdf.loss(small, small, convention="none")
    with pytest.raises(svbrdf.Error, match="at least one scene"):
        svbrdf.loss(small, small, near=0, distant=0)
    with pytest.raises(svbrdf.Error, match="unknown number of texels `0`"):
        svbrdf.loss(small, small, texels=0)
    below = svbrdf.Scene("near", (0, 0, 1), (0, 0, -1))
    with pytest.raises(svbrdf.Error, match=r"its light .* is not above the plane"):
        svbrdf.loss(small, small, scenes=[below])


def test_arguments_are_checked_by_name() -> None:
    material = svbrdf.Material(**maps(4, 4))
    with pytest.raises(ValueError, match="predictions: expected at least one"):
        svbrdf.loss(material, [])
    with pytest.raises(ValueError, match=r"target_error: expected a number above 0, such as 0\.01, found 1\.5"):
        svbrdf.loss(material, material, target_error=1.5)
    for whole in ("near", "distant", "seed"):
        for wrong, error in ((-1, ValueError), (1 << 64, ValueError), (1.5, TypeError), ("6", TypeError)):
            given: dict[str, Any] = {whole: wrong}
            with pytest.raises(error, match=f"{whole}: expected a whole number, 0 or more and below 2.64, found"):
                svbrdf.loss(material, material, **given)
            with pytest.raises(error, match=f"{whole}: expected a whole number"):
                svbrdf.sample_scenes(**given)
    with pytest.raises(ValueError, match="top: expected a whole number"):
        svbrdf.scenes(material, material, top=-1)
    with pytest.raises(ValueError, match="seed: expected a whole number"):
        svbrdf.rank_dataset("gt", "ours", seed=-1)
    with pytest.raises(ValueError, match="time_budget: expected seconds above 0"):
        svbrdf.loss(material, material, time_budget=0)
    with pytest.raises(ValueError, match="target_error is not used: the scenes are a fixed list"):
        svbrdf.loss(material, material, target_error=0.1, scenes=svbrdf.sample_scenes())
    with pytest.raises(ValueError, match="near is not used: the target error decides the scenes; leave out near"):
        svbrdf.loss(material, material, target_error=0.1, near=6, texels=3)
    with pytest.raises(ValueError, match="sampler is not used: the scenes are a fixed list"):
        svbrdf.scenes(material, material, sampler="random", scenes=svbrdf.sample_scenes())
    with pytest.raises(ValueError, match="seed: not used with over='lights'"):
        svbrdf.map(material, material, over="lights", seed=1)
    with pytest.raises(ValueError, match="fixed: not used with over='texels'"):
        svbrdf.map(material, material, fixed=(0, 0, 1))
    with pytest.raises(ValueError, match="side: expected 1 to 1024, found 0"):
        svbrdf.map(material, material, over="views", side=0)
    with pytest.raises(svbrdf.Error, match="unknown axes of a map `time`"):
        svbrdf.map(material, material, over="time")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"expected a svbrdf.Material or the path of one, found dict"):
        svbrdf.loss(material, [maps(4, 4)])  # type: ignore[list-item]
    with pytest.raises(FileNotFoundError, match=r"cannot read .*nowhere"):
        svbrdf.loss(material, "/nowhere/at/all.png")


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


def test_what_leaves_the_number_of_scenes_open_leaves_the_accuracy() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    usual = svbrdf.loss(ground_truth, prediction).results[0].loss
    assert svbrdf.loss(ground_truth, prediction, sampler="sobol", texels=32).results[0].loss == usual
    with pytest.raises(svbrdf.Error, match="not with sampler random; specify the number"):
        svbrdf.loss(ground_truth, prediction, sampler="random")
    counts = [svbrdf.loss(ground_truth, prediction, near=6), svbrdf.loss(ground_truth, prediction, distant=2)]
    assert [(report.near, report.distant) for report in counts] == [(6, 3), (4, 2)]


@pytest.mark.parametrize("given", ["1%", [0.01], True])
def test_a_target_error_that_is_no_number_is_refused_by_its_name(given: Any) -> None:
    material = svbrdf.Material(**maps(5, 4))
    for call in (svbrdf.loss, svbrdf.rank, svbrdf.blame):
        with pytest.raises(TypeError, match=r"^target_error: expected a number, such as 0\.01, found"):
            call(material, material, target_error=given)
    with pytest.raises(TypeError, match=r"^target_error: expected a number"):
        svbrdf.rank_dataset("gt", "ours", target_error=given)


def test_a_target_error_that_could_be_percent_is_refused() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    for function in (svbrdf.loss, svbrdf.blame, svbrdf.rank):
        with pytest.raises(ValueError, match=r"found 0\.5, which is 50%; for 0\.5% give 0\.005"):
            function(ground_truth, prediction, target_error=0.5)

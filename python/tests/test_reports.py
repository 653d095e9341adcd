"""Reports: the text, the JSON and the CSV of the command line."""

import json
import math
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal, get_type_hints

import numpy as np
import pytest
import svbrdf
from conftest import maps, problems

pandas = pytest.importorskip("pandas", reason="pandas is not installed")

Materials = tuple[Path, list[Path]]

CASES: dict[str, tuple[list[str], Callable[..., svbrdf.Report]]] = {
    "loss of few scenes": (
        ["--near=5", "--seed=7", "--sampler=sobol", "--texels=64", "--precision=f64", "--convention=guided-2020"],
        lambda gt, p: svbrdf.loss(
            gt, p, near=5, seed=7, sampler="sobol", texels=64, precision="f64", convention="guided-2020"
        ),
    ),
    "blame": (["--target-error", "5%"], lambda gt, p: svbrdf.blame(gt, p, target_error=0.05)),
    "rank in few scenes": (
        ["--near", "6", "--distant", "3", "--sampler", "sobol", "--seed", "2"],
        lambda gt, p: svbrdf.rank(gt, p, near=6, distant=3, sampler="sobol", seed=2),
    ),
    "diagnose": (["--seed", "1"], lambda gt, p: svbrdf.diagnose(gt, p, seed=1)),
    "worst": (["--seed", "1"], lambda gt, p: svbrdf.worst(gt, p, seed=1)),
    "scenes": (
        ["--near", "9", "--distant", "4", "--top", "5"],
        lambda gt, p: svbrdf.scenes(gt, p, near=9, distant=4, top=5),
    ),
    "metrics at an exposure": (
        ["--lights", "flash-9", "--exposure", "1"],
        lambda gt, p: svbrdf.metrics(gt, p, scenes=svbrdf.named_scenes("flash-9"), exposure=1),
    ),
}


@pytest.fixture(scope="module")
def materials(tmp_path_factory: pytest.TempPathFactory) -> Materials:
    """A ground truth and two predictions, the second of which has the same roughness."""
    folder = tmp_path_factory.mktemp("materials")
    truth = maps(13, 11)
    blurred = {**truth, "normal": np.broadcast_to(np.array([0, 0, 1], np.float32), (13, 11, 3))}
    paths = []
    for name, given in {"gt": truth, "rough": {**maps(13, 11, 1), "normal": truth["normal"]}, "flat": blurred}.items():
        paths.append(folder / f"{name}.exr")
        svbrdf.write(svbrdf.Material(**given), paths[-1], depth="float")
    return paths[0], paths[1:]


def assert_is_printed(report: svbrdf.Report, program: str, *command: str | Path) -> None:
    """The report has the JSON, as its schema says, the text and the CSV of a command."""

    def printed(output: str) -> str:
        whole = [program, *map(str, command), "--format", output]
        return subprocess.run(whole, check=True, capture_output=True, text=True).stdout

    expected = json.loads(printed("json"))
    assert problems(str(command[0]), expected) == []
    # A report of Python is of no command.
    for key in ("repetition", "readings"):
        expected.pop(key, None)
    assert report.to_dict() == expected
    assert str(report) + "\n" == printed("text").partition("\nrepeat with ")[0]
    assert report._views["csv"] == printed("csv")


@pytest.mark.parametrize("case", CASES)
def test_a_report_has_the_keys_the_numbers_the_text_and_the_csv_of_the_command_line(
    program: str, materials: Materials, case: str
) -> None:
    first, others = materials
    assert_is_printed(CASES[case][1](first, others), program, case.split()[0], first, *others, *CASES[case][0])


def test_a_data_frame_has_the_numbers_to_their_last_bits(materials: Materials) -> None:
    report = svbrdf.loss(*materials, near=2)
    frame = report.to_pandas()
    assert list(frame["prediction"]) == ["rough", "flat"]
    assert list(frame["loss"]) == [result.loss for result in report.results]


def test_changing_a_dictionary_changes_no_report(materials: Materials) -> None:
    report = svbrdf.loss(*materials, near=2)
    report.to_dict()["results"][0]["loss"] = 7
    assert report.to_dict()["results"][0]["loss"] == report.results[0].loss
    assert report == svbrdf.loss(*materials, near=2) != svbrdf.loss(*materials, near=2, seed=1)
    assert repr(report) == str(report) == report.text.rstrip("\n")


def test_a_report_is_read_only_and_an_unknown_attribute_names_the_known_ones(materials: Materials) -> None:
    report = svbrdf.loss(*materials, near=2)
    with pytest.raises(AttributeError, match=r"LossReport has no attribute 'looses'; it has: ground_truth, .* results"):
        report.looses  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(AttributeError, match=r"LossReport\.seed: reports are read-only"):
        report.seed = 3
    assert isinstance(report.results[0], svbrdf.Loss)
    assert {*report.to_dict(), "text", "to_dict", "to_pandas"} <= set(dir(report))
    assert report.results[0]["loss"] == report["results"][0].loss == report.results[0].loss
    assert report.results[0].few_scenes_loss is None
    assert repr(report.differences[0]).startswith("LossDifference(prediction='flat', to='rough', difference=")


def test_without_pandas_the_error_says_what_to_install(materials: Materials, monkeypatch: pytest.MonkeyPatch) -> None:
    report = svbrdf.loss(*materials, near=2)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="to_pandas needs pandas, which is not installed; `pip install pandas`"):
        report.to_pandas()


def test_a_map_is_that_of_the_command_line_with_arrays(program: str, materials: Materials, tmp_path: Path) -> None:
    ground_truth, predictions = materials
    report = svbrdf.map(ground_truth, predictions, near=4, distant=2)
    for values, summary in zip(report.maps, report.results, strict=True):
        assert values.shape == (13, 11, 3)
        assert np.mean(values) == pytest.approx(summary.mean, rel=1e-6)
        assert values[summary.row, summary.column].mean() == pytest.approx(summary.largest, rel=1e-6)
    command = [program, "map", str(ground_truth), *map(str, predictions), "-o", str(tmp_path / "map.csv")]
    ended = subprocess.run([*command, "--near", "4", "--distant", "2"], check=True, capture_output=True, text=True)
    assert problems("map", report.to_dict()) == []
    assert str(report) + "\n" == ended.stdout
    pandas.testing.assert_frame_equal(
        report.to_pandas(), pandas.read_csv(tmp_path / "map.csv", float_precision="round_trip"), check_dtype=False
    )


def test_equal_materials_have_an_infinite_psnr_which_is_none_in_the_dictionary(materials: Materials) -> None:
    ground_truth, _ = materials
    report = svbrdf.metrics(ground_truth, ground_truth, near=1)
    assert report.results[0].metrics["psnr_rendering_clipped_linear"] is None
    frame = report.to_pandas().set_index("metric")
    assert math.isinf(frame.loc["psnr_rendering_clipped_linear"].iloc[0])


def test_types_follow_schemas() -> None:
    hints = get_type_hints(svbrdf.Loss)
    assert str(hints["interval95"]) == "tuple[float, float] | None"
    assert hints["prediction"] is str
    assert get_type_hints(svbrdf.LossReport)["results"] == tuple[svbrdf.Loss, ...]
    assert get_type_hints(svbrdf.LossReport)["sampler"] == Literal["random", "sobol"] | None
    assert get_type_hints(svbrdf.Metrics)["metrics"] == Mapping[str, float | None]

"""Methods over data sets: the numbers of the command line."""

import json
import shlex
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import maps, problems
from PIL import Image


@pytest.fixture
def dataset(tmp_path: Path) -> Path:
    """Eight materials, two methods: one has a broken file, the other two predictions of a material."""
    for folder in ("gt", "good", "bad"):
        (tmp_path / folder).mkdir()
    for index in range(8):
        truth = maps(12, 10, index)
        svbrdf.write(svbrdf.Material(**truth), tmp_path / "gt" / f"m{index}.exr", depth="float")
        Image.fromarray(255 * (truth["roughness"] > 0.5).astype(np.uint8)).save(tmp_path / f"m{index}.png")
        for method, share in {"good": 0.9, "bad": 0.6}.items():
            near = {**truth, "roughness": truth["roughness"] * share, "diffuse": truth["diffuse"] * share}
            name = f"m{index}_0.exr" if (method, index) == ("bad", 1) else f"m{index}.exr"
            svbrdf.write(svbrdf.Material(**near), tmp_path / method / name, depth="float")
    svbrdf.write(svbrdf.Material(**maps(12, 10, 1)), tmp_path / "bad" / "m1_1.exr", depth="float")
    (tmp_path / "good" / "m3.exr").write_bytes(b"nothing")
    return tmp_path


def text_of_command_line(program: str, dataset: Path, *options: str) -> str:
    """The ranking of both methods."""
    folders = [str(dataset / name) for name in ("gt", "good", "bad")]
    command = [program, "rank", "--dataset", *folders, "--target-error", "5%", *options]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def of_command_line(program: str, dataset: Path, *options: str) -> Any:
    return json.loads(text_of_command_line(program, dataset, "--format", "json", *options))


def ranked(dataset: Path, **options: Any) -> svbrdf.DatasetReport:
    methods = [dataset / name for name in ("good", "bad")]
    return svbrdf.rank_dataset(dataset / "gt", methods, **{"target_error": 0.05, **options})


def predictions(report: svbrdf.DatasetReport) -> list[svbrdf.PredictionResult]:
    return [prediction for result in report.results for prediction in result.predictions]


@pytest.mark.parametrize(
    ("options", "given"),
    [
        (["--pick", "mean", "--metrics", "--results", "kept"], {"pick": "mean", "metrics": True, "results": "kept"}),
        (["--pick", "best", "--diagnose"], {"pick": "best", "diagnose": True}),
        (["--protocol", "marigold-iid"], {"protocol": "marigold-iid"}),
        (["--metrics=rmse_roughness,psnr"], {"metrics": ["rmse_roughness", "psnr"]}),
        (["--mask", "{}.png", "--register", "resize"], {"mask": "{}.png", "register": "resize"}),
        ([], {}),
    ],
)
def test_a_data_set_has_the_numbers_of_the_command_line(
    program: str, dataset: Path, options: list[str], given: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(dataset)
    found = of_command_line(program, dataset, *options)
    report = ranked(dataset, **given)
    assert report.to_dict() == found
    assert problems("dataset", found) == []
    assert repr(report) + "\n" == text_of_command_line(program, dataset, *options)
    expected = [p for result in found["results"] for p in result["predictions"]]
    assert [prediction.loss for prediction in predictions(report)] == [p.get("loss") for p in expected]
    assert [prediction.metrics for prediction in predictions(report)] == [p.get("metrics") for p in expected]
    assert [m.marks.marked if m.marks else None for m in report.methods] == [
        m["marks"]["marked"] if "diagnose" in given else None for m in found["methods"]
    ]
    # The good method lacks a material: it is not compared.
    assert [(summary.method, summary.compared) for summary in report.methods] == [("bad", True), ("good", False)]
    assert list(report.to_pandas()["loss"].dropna()) == [p["loss"] for p in expected if "loss" in p]


def test_a_data_set_in_scenes_has_the_numbers_of_the_command_line(
    program: str, dataset: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(dataset)
    scenes = [svbrdf.Scene("near", (0, 0, 2), (0.1 * i, 0, 1)) for i in range(3)]
    own = json.dumps({"scenes": [scene._asdict() for scene in scenes]})
    Path("SCENES.json").write_text(own)
    for options, given in [
        ("--near 6 --distant 3 --sampler sobol --seed 2", {"near": 6, "distant": 3, "sampler": "sobol", "seed": 2}),
        ("--distant 2", {"distant": 2}),
        ("--lights flash-9", {"scenes": svbrdf.named_scenes("flash-9")}),
        ("--scenes SCENES.json", {"scenes": "SCENES.json"}),
        ("--scenes SCENES.json", {"scenes": scenes}),
    ]:
        command = [program, "rank", "--dataset", "gt", "good", "bad", "--format", "json", *options.split()]
        found = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        report = svbrdf.rank_dataset("gt", ["good", "bad"], **given)  # type: ignore[arg-type]
        assert report.to_dict() == json.loads(found), options
        # The command of the ranking makes it again.
        repeated = [program, *shlex.split(report.repetition.command)[1:], "--format", "json"]
        again = subprocess.run(repeated, check=True, capture_output=True, text=True).stdout
        assert again == found, repeated
    fewer = svbrdf.rank_dataset("gt", ["good", "bad"], scenes=scenes[:2])
    assert predictions(fewer)[0].loss != predictions(report)[0].loss


def test_a_broken_file_is_a_result_that_says_why(dataset: Path) -> None:
    seen: list[tuple[int, int]] = []
    report = svbrdf.rank_dataset(
        dataset / "gt", {"ours": dataset / "good"}, target_error=0.1, progress=lambda *counts: seen.append(counts)
    )
    (failed,) = [prediction for prediction in predictions(report) if prediction.loss is None]
    assert failed == report.results[3].predictions[0]
    assert failed.error is not None
    assert "cannot decode" in failed.error
    assert "m3.exr" in failed.error
    assert seen[-1] == (8, 8)


def test_read_options_reach_the_files_and_wrong_ones_are_refused(dataset: Path) -> None:
    def first(**options: Any) -> float | None:
        report = svbrdf.rank_dataset(dataset / "gt", dataset / "bad", target_error=0.1, **options)
        return predictions(report)[0].loss

    assert first(read_predictions={"roughness": "gloss"}) != first()
    with pytest.raises(svbrdf.Error, match="unknown value"):
        first(read_ground_truth={"normal_y": "left"})
    with pytest.raises(svbrdf.Error, match="unknown choice of samples"):
        first(pick="last")
    with pytest.raises(ValueError, match="register: no method is named good; the names are bad"):
        first(register={"good": "resize"})
    with pytest.raises(FileNotFoundError):
        svbrdf.rank_dataset(dataset / "nowhere", dataset / "bad")
    with pytest.raises(ValueError, match="methods: expected at least one"):
        svbrdf.rank_dataset(dataset / "gt", [])

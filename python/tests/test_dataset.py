"""Methods over data sets: the numbers of the command line."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
import svbrdf
from conftest import maps


@pytest.fixture
def dataset(tmp_path: Path) -> Path:
    """Eight materials, two methods: one has a broken file, the other two predictions of a material."""
    for folder in ("gt", "good", "bad"):
        (tmp_path / folder).mkdir()
    for index in range(8):
        truth = maps(12, 10, index)
        svbrdf.write(svbrdf.Material(**truth), tmp_path / "gt" / f"m{index}.exr", depth="float")
        for method, share in {"good": 0.9, "bad": 0.6}.items():
            near = {**truth, "roughness": truth["roughness"] * share, "diffuse": truth["diffuse"] * share}
            name = f"m{index}_0.exr" if (method, index) == ("bad", 1) else f"m{index}.exr"
            svbrdf.write(svbrdf.Material(**near), tmp_path / method / name, depth="float")
    svbrdf.write(svbrdf.Material(**maps(12, 10, 1)), tmp_path / "bad" / "m1_1.exr", depth="float")
    (tmp_path / "good" / "m3.exr").write_bytes(b"nothing")
    return tmp_path


@pytest.mark.parametrize("pick", ["fixed", "mean", "best"])
def test_a_data_set_has_the_numbers_of_the_command_line(program: str, dataset: Path, pick: Any) -> None:
    folders = [dataset / name for name in ("gt", "good", "bad")]
    command = [program, "rank", "--dataset", *map(str, folders), "--target-error", "5%", "--pick", pick]
    found = json.loads(subprocess.run([*command, "--format", "json"], check=True, capture_output=True).stdout)
    report = svbrdf.rank_dataset(folders[0], folders[1:], target_error=0.05, pick=pick)
    got = json.loads(json.dumps(report.to_dict()))
    assert got["methods"] == found["methods"]
    expected = [p["result"].get("Ok", {}).get("loss") for result in found["results"] for p in result["predictions"]]
    assert [result.loss for result in report.results] == expected
    assert [summary.method for summary in report.methods] == ["good", "bad"]
    assert repr(report).splitlines()[1].split()[:3] == ["good", "7", "1"]


def test_a_broken_file_is_a_result_that_says_why(dataset: Path) -> None:
    seen: list[tuple[int, int]] = []
    report = svbrdf.rank_dataset(
        dataset / "gt", {"ours": dataset / "good"}, target_error=0.1, progress=lambda *counts: seen.append(counts)
    )
    (failed,) = [result for result in report.results if result.loss is None]
    assert (failed.material, failed.method) == ("m3", "ours")
    assert failed.error is not None
    assert "m3.exr is not a readable image" in failed.error
    assert seen[-1] == (8, 8)


def test_read_options_reach_the_files_and_wrong_ones_are_refused(dataset: Path) -> None:
    def first(**options: Any) -> float | None:
        return svbrdf.rank_dataset(dataset / "gt", dataset / "bad", target_error=0.1, **options).results[0].loss

    assert first(read_predictions={"roughness": "gloss"}) != first()
    with pytest.raises(svbrdf.Error, match="unknown variant"):
        first(read_ground_truth={"normal_y": "left"})
    with pytest.raises(svbrdf.Error, match="unknown choice of samples"):
        first(pick="last")
    with pytest.raises(FileNotFoundError):
        svbrdf.rank_dataset(dataset / "nowhere", dataset / "bad")
    with pytest.raises(ValueError, match="methods: expected at least one"):
        svbrdf.rank_dataset(dataset / "gt", [])

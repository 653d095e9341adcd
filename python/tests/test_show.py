"""Opening the window."""

import json
import os
import subprocess
from pathlib import Path

import pytest
import svbrdf
from conftest import maps
from svbrdf._show import write_session


def test_the_program_gets_a_session_that_is_removed_afterwards(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen, copy = tmp_path / "seen", tmp_path / "copy"
    program = tmp_path / "svbrdf"
    program.write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" > {seen}\ncp -r "$(dirname "$3")" {copy}\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.delenv("SVBRDF_PROGRAM", raising=False)
    ground_truth, prediction = svbrdf.Material(**maps(4, 4), name="a/b"), svbrdf.Material(**maps(4, 4, 1))
    scene = svbrdf.Scene("distant", (0, 0, 1), (0.5, 0, 1))
    window = svbrdf.show(ground_truth, [prediction, "other.png"], scene=scene, convention="guided-2020", wait=True)
    assert window.returncode == 0
    view, dashes, session = seen.read_text().splitlines()
    assert (view, dashes) == ("view", "--")
    assert not Path(session).parent.exists()
    saved = json.loads((copy / Path(session).name).read_text())
    assert saved["convention"] == "guided-2020"
    assert saved["scene"] == {"kind": "distant", "view": [0, 0, 1], "light": [0.5, 0, 1]}
    first, second, other = (entry["path"] for entry in saved["materials"])
    assert (first, second) == ("0/a_b.exr", "1/material.exr")
    assert (Path(session).parent / other).resolve() == Path("other.png").resolve()
    # Floats of 32 bits: the material of the window is the material.
    assert svbrdf.loss(ground_truth, svbrdf.read(copy / first, normal_y="up")).results[0].loss == 0


def test_a_data_set_is_shown_by_its_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen, program = tmp_path / "seen", tmp_path / "program"
    program.write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" > {seen}\n')
    program.chmod(0o755)
    monkeypatch.setenv("SVBRDF_PROGRAM", str(program))
    folders = [str(tmp_path / name) for name in ("gt", "ours", "theirs")]
    results = tmp_path / "results"
    window = svbrdf.show(folders[0], folders[1:], dataset=True, results=results, wait=True)
    assert window.returncode == 0
    assert seen.read_text().splitlines() == ["view", "--dataset", "--results", str(results), "--", *folders]
    with pytest.raises(ValueError, match="at least one method"):
        svbrdf.show(folders[0], dataset=True)
    with pytest.raises(ValueError, match="dataset=True beside results"):
        svbrdf.show(folders[0], folders[1:], results=results)


@pytest.mark.filterwarnings("ignore::svbrdf.AssumptionWarning")
def test_the_session_gives_the_loss_bit_for_bit(program: str, tmp_path: Path) -> None:
    """The window opens such a file with the reader and the comparison of the core, which the command line uses here."""
    folder = tmp_path / "maps"
    svbrdf.write(svbrdf.Material(**maps(16, 16, 2)), folder)
    svbrdf.write(svbrdf.Material(**maps(16, 16, 3)), tmp_path / "saved.png")
    (tmp_path / "saved.png.svbrdf.json").write_text('{"roughness": "gloss"}')
    materials: list[svbrdf.Material | Path] = [
        svbrdf.Material(**maps(16, 16, 1)),
        # Options that are not the ones that would be found.
        svbrdf.read(folder, albedo="srgb", normal_y="down"),
        svbrdf.read(tmp_path / "saved.png", normal_y="up"),
        tmp_path / "saved.png",
    ]
    session = write_session(tmp_path, materials, svbrdf.Scene("near", (0, 0, 2.5), (0.4, 0.5, 1.2)), "printed")
    command = [program, "loss", str(session), "--near", "4", "--format", "json"]
    found = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    ground_truth, *predictions = materials
    expected = svbrdf.loss(ground_truth, predictions, near=4)
    assert [result["loss"] for result in found["results"]] == [result.loss for result in expected.results]
    assert found["results"][0]["loss"] != svbrdf.loss(ground_truth, svbrdf.read(folder), near=4).results[0].loss
    assert len({result.loss for result in expected.results[:2]}) == 2


def test_a_window_that_cannot_be_opened_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SVBRDF_PROGRAM", str(tmp_path / "nothing"))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    with pytest.raises(FileNotFoundError):
        svbrdf.show(svbrdf.built_in()[0])
    with pytest.raises(svbrdf.Error, match="unknown convention `none`"):
        svbrdf.show(svbrdf.built_in()[0], convention="none")
    assert not list(tmp_path.iterdir())


def test_where_the_program_is_missing_the_error_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("SVBRDF_PROGRAM", raising=False)
    with pytest.raises(FileNotFoundError, match="cargo install --locked --path"):
        svbrdf.show(svbrdf.built_in()[0])

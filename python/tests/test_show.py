"""Opening the window."""

import os
from pathlib import Path

import pytest
import svbrdf
from conftest import maps


def test_arrays_reach_the_program_as_files_that_are_removed_afterwards(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen, copy = tmp_path / "seen", tmp_path / "copy.exr"
    program = tmp_path / "svbrdf"
    program.write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" > {seen}\ncp "$3" {copy}\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.delenv("SVBRDF_PROGRAM", raising=False)
    ground_truth, prediction = svbrdf.Material(**maps(4, 4), name="a/b"), svbrdf.Material(**maps(4, 4, 1))
    assert svbrdf.show(ground_truth, [prediction, "other.png"], wait=True).returncode == 0
    view, dashes, first, second, other = seen.read_text().splitlines()
    assert (view, dashes) == ("view", "--")
    assert Path(first).name == "a_b.exr"
    assert not Path(first).exists()
    assert not Path(second).exists()
    assert other == str(Path("other.png").absolute())
    assert svbrdf.loss(ground_truth, svbrdf.read(copy, normal_y="up")).loss == 0


def test_where_the_program_is_missing_the_error_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("SVBRDF_PROGRAM", raising=False)
    with pytest.raises(FileNotFoundError, match="cargo install --locked --path"):
        svbrdf.show(svbrdf.built_in()[0])

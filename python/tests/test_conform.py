"""`svbrdf.conform`, and the code of docs/conventions.md."""

import os
import re
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf

PAGE = Path(__file__).parents[2] / "docs" / "conventions.md"
NUMPY, TORCH = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)


def test_the_numpy_code_of_the_page_conforms(program: str, tmp_path: Path) -> None:
    subprocess.run([program, "conform", "--points", tmp_path / "probe.npz"], check=True)
    folder = Path.cwd()
    os.chdir(tmp_path)
    try:
        exec(NUMPY, {})
    finally:
        os.chdir(folder)
    answer = str(tmp_path / "answer.npz")
    asked = [program, "conform", answer, "--convention", "svbrdf-estimation-2022"]
    printed = subprocess.run(asked, check=True, capture_output=True, text=True).stdout
    assert printed.startswith("The renderer conforms to `svbrdf-estimation-2022`.")


def test_the_pytorch_code_of_the_page_conforms() -> None:
    pytest.importorskip("torch")
    names: dict[str, Any] = {}
    exec(TORCH, names)
    assert names["report"].verdict == "conforms"
    assert names["report"].storage == "float32"


def render(maps: dict[str, Any], view: Any, light: Any) -> Any:
    names: dict[str, Any] = {}
    exec(NUMPY.partition("probe = ")[0], names)
    return names["render"](maps, view, light)


def test_a_difference_is_named() -> None:
    report = svbrdf.conform(
        lambda maps, view, light: render(maps, view, light) * (light**2).sum(-1, keepdims=True),
        convention="svbrdf-estimation-2022",
    )
    assert report.verdict == "differs"
    assert [(d.term, d.found) for d in report.differences] == [("falloff", "none")]
    assert report.renderer is not None
    assert report.renderer["specular"]["G"] == "smith"


def test_a_renderer_outside_of_the_grammar_has_no_name() -> None:
    def tone_mapped(maps: dict[str, Any], view: Any, light: Any) -> Any:
        radiance = render(maps, view, light)
        return radiance / (1 + radiance)

    report = svbrdf.conform(tone_mapped)
    assert (report.verdict, report.renderer) == ("unknown", None)
    assert report.nearest is not None


def test_what_is_no_radiance_is_an_error() -> None:
    with pytest.raises(svbrdf.Error, match="`radiance`: expected 392 x 3 values"):
        svbrdf.conform(lambda maps, view, light: np.ones(3))
    with pytest.raises(svbrdf.Error, match="unknown convention `none`"):
        svbrdf.conform(render, convention="none")

"""The report, the figure, and what a notebook shows."""

import base64
import html
import json
import re
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import maps

HOSTILE = '</table><script>alert(1)</script>\u202e&"'


def pair() -> list[svbrdf.Material]:
    names = ("truth", HOSTILE)
    return [svbrdf.Material(**maps(24, 24, seed), name=name) for seed, name in enumerate(names)]


def data(page: str) -> dict[str, Any]:
    found = re.search(r'id="data">(.*?)</script>', page)
    assert found
    values: dict[str, Any] = json.loads(found.group(1))
    return values


def test_a_report_has_the_losses_the_call_and_the_readings(tmp_path: Path) -> None:
    ground_truth, prediction = pair()
    file = tmp_path / "p.png"
    svbrdf.write(prediction, file)
    path, read = tmp_path / "report.html", svbrdf.read(file, normal_y="up", albedo="linear")
    svbrdf.report(ground_truth, read, path, target_error=0.1, seed=3, layout="wipe", exposure=1.5)
    page = path.read_text()
    loss = svbrdf.loss(ground_truth, read, target_error=0.1, seed=3).results[0].loss
    assert f"<td>{loss:.4f}</td>" in page or f"<td>{loss:.3f}</td>" in page
    text = html.unescape(page)
    assert f"svbrdf.report(<svbrdf.Material 'truth'>, [svbrdf.read({str(file)!r}, " in text
    assert "target_error=0.1, seed=3, exposure=1.5, layout='wipe'" in text
    assert "Assumptions in reading the files" in page
    start = data(page)["start"]
    assert (start["layout"], start["exposure"]) == ("wipe", 1.5)
    with pytest.raises(svbrdf.Error, match=r"NAME\.html"):
        svbrdf.report(ground_truth, read, tmp_path / "report.txt")
    with pytest.raises(svbrdf.Error, match="exposure: expected stops from -16 to 16"):
        svbrdf.report(ground_truth, read, path, exposure=float("nan"))


def test_a_figure_is_the_figure_alone_in_a_sandbox() -> None:
    scene = svbrdf.Scene("distant", (0, 0.1, 1), (0.5, 0, 1))
    figure = svbrdf.figure(*pair(), scene=scene, height=300)
    values = data(figure.html)
    assert values["start"]["scene"]["light"] == [0.5, 0, 1]
    assert [material["name"] for material in values["materials"]] == ["truth", HOSTILE.replace("\u202e", r"\u{202e}")]
    shown = figure._repr_html_()
    assert '<iframe sandbox="allow-scripts"' in shown
    assert html.unescape(shown[shown.index('srcdoc="') + 8 : -len('"></iframe>')]) == figure.html
    assert "<h2" not in figure.html
    assert len(data(svbrdf.figure(pair()[0]).html)["materials"]) == 1
    with pytest.warns(UserWarning, match="reduced to 16 x 16"):
        svbrdf.figure(*(svbrdf.Material(**maps(32, 32, seed)) for seed in (0, 1)), max_size=1000)


def test_a_table_has_every_word_of_the_text_and_escaped_names() -> None:
    ground_truth, prediction = pair()
    for report in (
        svbrdf.loss(ground_truth, prediction),
        svbrdf.rank(ground_truth, [prediction, ground_truth]),
        svbrdf.scenes(ground_truth, prediction, near=61, distant=0, top=61),
        svbrdf.blame(ground_truth, prediction),
        svbrdf.diagnose(ground_truth, prediction),
        svbrdf.metrics(ground_truth, prediction, metrics=["roughness"]),
    ):
        table = report._repr_html_()
        assert "<script" not in table
        assert table.count("</table>") == 1
        shown = html.unescape(re.sub(r"<[^>]*>", " ", table))
        assert [word for word in report.text.split() if word not in shown] == []


def test_a_material_shows_its_maps() -> None:
    for precision in ("f32", "f64"):
        shown = svbrdf.built_in(precision=precision)[0]._repr_html_()
        picture = shown[shown.index("base64,") + 7 : shown.index('" alt')]
        # A JPEG of five pictures of 128 pixels, with two between them.
        jpeg = base64.b64decode(picture)
        frame = jpeg.index(b"\xff\xc0") + 5
        assert struct.unpack(">HH", jpeg[frame : frame + 4]) == (128, 5 * 128 + 4 * 2)
        assert "worn tiles, 256 &times; 256 texels" in shown


NOTEBOOK = """
import svbrdf
ground_truth, *predictions = svbrdf.built_in()
svbrdf.loss(ground_truth, predictions, near=2)
---
svbrdf.figure(ground_truth, predictions, layout="wipe", height=600)
"""


@pytest.mark.filterwarnings("ignore")
def test_a_notebook_shows_the_table_and_the_figure_starts_in_a_browser(tmp_path: Path) -> None:
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed")
    pytest.importorskip("ipykernel", reason="ipykernel is not installed")
    image = pytest.importorskip("matplotlib.image", reason="matplotlib is not installed")
    from nbformat.v4 import new_code_cell, new_notebook

    notebook = new_notebook(cells=[new_code_cell(cell) for cell in NOTEBOOK.split("---")])
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    outputs = [cell.outputs[0].data["text/html"] for cell in notebook.cells]
    assert "wrong roughness</td>" in outputs[0]
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("chromium is not installed")

    def screenshot(name: str, body: str) -> Any:
        page, picture = tmp_path / f"{name}.html", tmp_path / f"{name}.png"
        page.write_text(f'<!doctype html><meta charset="utf-8"><body>{body}</body>')
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--hide-scrollbars"]
        options += ["--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--window-size=1000,900"]
        # In the process of the page, whose time the budget below counts.
        options += ["--disable-features=IsolateSandboxedIframes"]
        options += [f"--user-data-dir={tmp_path / 'profile'}", "--virtual-time-budget=30000", f"--screenshot={picture}"]
        subprocess.run([chromium, *options, page.as_uri()], check=True, capture_output=True, timeout=300)
        return (255 * image.imread(picture)[..., :3]).round().astype(np.int16)

    live = screenshot("live", "".join(outputs))
    # A frame without scripts has the still picture alone: no controls, and no line of the wipe.
    still = screenshot("still", "".join(outputs).replace('sandbox="allow-scripts"', 'sandbox=""'))
    assert (np.abs(live - still).max(axis=-1) > 20).mean() > 0.1
    assert len(np.unique(live.reshape(-1, 3), axis=0)) > 5000

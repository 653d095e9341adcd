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
    with pytest.raises(ValueError, match="exposure"):
        svbrdf.report(ground_truth, read, path, exposure=float("nan"))


ABOUT = {
    "title": 'Tiles & "more"',
    "authors": "A. Author, B. Author",
    "caption": "Two <predictions>.",
    "bibtex": "@article{key,\n  title = {Tiles},\n}",
    "image": "https://example.org/p.jpg",
}


def test_the_texts_of_the_authors_are_those_of_the_command_line(program: str, tmp_path: Path) -> None:
    paths = [tmp_path / "truth.exr", tmp_path / "ours.exr"]
    for path, material in zip(paths, pair(), strict=True):
        svbrdf.write(material, path, depth="float")
    toml, page = tmp_path / "about.toml", tmp_path / "of_program.html"
    toml.write_text("".join(f"{key} = {json.dumps(text)}\n" for key, text in ABOUT.items()))
    command = [program, "report", *map(str, paths), "--target-error", "10%", "--about", str(toml), "-o", str(page)]
    subprocess.run(command, check=True, capture_output=True)

    def of_python(about: dict[str, str] | Path) -> str:
        svbrdf.report(paths[0], paths[1], tmp_path / "of_python.html", target_error=0.1, about=about)
        return without_call((tmp_path / "of_python.html").read_text())

    def without_call(text: str) -> str:
        found = re.split(r"<pre><code>svbrdf.*?</code></pre>", text, flags=re.DOTALL)
        assert len(found) == 2
        return "".join(found)

    expected = without_call(page.read_text())
    assert expected.count("A. Author, B. Author") == 1
    assert of_python(ABOUT) == expected
    assert of_python(toml) == expected
    assert of_python({**ABOUT, "caption": "Another."}) != expected
    call = html.unescape((tmp_path / "of_python.html").read_text())
    assert "about={'title': 'Tiles & \"more\"', 'authors'" in call
    with pytest.raises(svbrdf.Error, match=r"about: unknown field `titel`, expected one of `title`"):
        of_python({"titel": "Tiles"})
    with pytest.raises(svbrdf.Error, match="about: invalid type"):
        of_python({"title": 3})  # type: ignore[dict-item]
    with pytest.raises(FileNotFoundError, match=r"none\.toml"):
        of_python(tmp_path / "none.toml")


def test_a_figure_is_the_figure_alone_in_a_sandbox() -> None:
    scene = svbrdf.Scene("distant", (0, 0.1, 1), (0.5, 0, 1))
    figure = svbrdf.figure(*pair(), scene=scene, height=300)
    values = data(figure.html)
    assert values["start"]["scene"]["light"] == [0.5, 0, 1]
    assert [material["name"] for material in values["materials"]] == ["truth", HOSTILE.replace("\u202e", r"\u{202e}")]
    shown = figure._repr_html_()
    assert '<iframe sandbox="allow-scripts"' in shown
    assert html.unescape(shown[shown.index('srcdoc="') + 8 : -len('"></iframe></div>')]) == figure.html
    assert "<h2" not in figure.html
    assert len(data(svbrdf.figure(pair()[0]).html)["materials"]) == 1
    with pytest.warns(UserWarning, match="reduced to 16 x 16"):
        svbrdf.figure(*(svbrdf.Material(**maps(32, 32, seed)) for seed in (0, 1)), max_size=1000)


def test_the_frame_of_a_figure_is_as_high_as_its_pictures() -> None:
    ground_truth, *predictions = (svbrdf.Material(**maps(16, 24, seed), name=str(seed)) for seed in range(6))
    for count, layout, share in [(0, "wipe", 2 / 3), (1, "side-by-side", 1 / 3), (2, "side-by-side", 2 / 3)]:
        figure = svbrdf.figure(ground_truth, predictions[:count], layout=layout, height=720)  # type: ignore[arg-type]
        assert figure.share == pytest.approx(0.95 * share)
        high = f"height: min(720px, calc({95 * share:.1f}cqw + 250px))"
        assert high in figure._repr_html_()
    # Two rows of three are larger than one of six.
    assert svbrdf.figure(ground_truth, predictions).share == pytest.approx(0.95 * 2 / 3 / 1.5)


def test_a_table_has_the_numbers_and_escaped_names() -> None:
    report = svbrdf.loss(*pair(), near=2)
    table = report._repr_html_()
    assert f"<td>{report.results[0].loss:.6f}</td>" in table
    assert "<script" not in table
    assert table.count("</table>") == 1
    assert html.escape("</table><script>alert(1)</script>") + "\\u{202e}&amp;&quot;" in table


def test_a_table_has_every_word_of_the_text() -> None:
    ground_truth, *predictions = [svbrdf.Material(**maps(24, 24, seed), name=name) for seed, name in enumerate("tab")]
    loss = svbrdf.loss(ground_truth, predictions)
    assert "b - a, same scenes" in loss.text
    for report in (
        loss,
        svbrdf.rank(ground_truth, predictions),
        svbrdf.scenes(ground_truth, predictions, near=61, distant=0, top=61),
        svbrdf.blame(ground_truth, predictions),
        svbrdf.diagnose(ground_truth, predictions),
        svbrdf.metrics(ground_truth, predictions, metrics=["roughness"]),
    ):
        shown = html.unescape(re.sub(r"<[^>]*>", " ", report._repr_html_()))
        missing = [word for word in report.text.split() if word not in shown]
        assert not missing, missing


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


@pytest.fixture(scope="module")
def outputs() -> list[str]:
    """The HTML of the cells of a notebook that has run."""
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed")
    pytest.importorskip("ipykernel", reason="ipykernel is not installed")
    from nbformat.v4 import new_code_cell, new_notebook

    notebook = new_notebook(cells=[new_code_cell(cell) for cell in NOTEBOOK.split("---")])
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    return [cell.outputs[0].data["text/html"] for cell in notebook.cells]


@pytest.mark.filterwarnings("ignore")
def test_a_notebook_shows_the_table_and_the_figure(outputs: list[str]) -> None:
    table, figure = outputs
    assert "wrong roughness</td>" in table
    assert "<iframe sandbox" in figure


@pytest.mark.filterwarnings("ignore")
def test_the_figure_of_a_notebook_starts_in_a_browser(outputs: list[str], tmp_path: Path) -> None:
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("chromium is not installed")
    image = pytest.importorskip("matplotlib.image", reason="matplotlib is not installed")

    def screenshot(name: str, body: str) -> Any:
        page, picture = tmp_path / f"{name}.html", tmp_path / f"{name}.png"
        page.write_text(f'<!doctype html><meta charset="utf-8"><body>{body}</body>')
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--hide-scrollbars"]
        options += ["--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--window-size=1000,900"]
        # In the process of the page, whose time the budget below counts.
        options += ["--disable-features=IsolateSandboxedIframes"]
        options += [f"--user-data-dir={tmp_path / 'profile'}", "--virtual-time-budget=30000", f"--screenshot={picture}"]
        command = [chromium, *options, page.as_uri()]
        subprocess.run(command, check=True, capture_output=True, timeout=300)
        return (255 * image.imread(picture)[..., :3]).round().astype(np.int16)

    live = screenshot("live", "".join(outputs))
    # A frame without scripts has the still picture alone: no controls, and no line of the wipe.
    still = screenshot("still", "".join(outputs).replace('sandbox="allow-scripts"', 'sandbox=""'))
    assert (np.abs(live - still).max(axis=-1) > 20).mean() > 0.1
    colours = np.unique(live.reshape(-1, 3), axis=0)
    assert len(colours) > 5000

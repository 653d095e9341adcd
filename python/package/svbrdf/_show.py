"""The desktop window."""

import atexit
import os
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Sequence
from pathlib import Path

from . import _core
from ._material import Material, Source, write
from ._scenes import Scene

MISSING = (
    "the program svbrdf, which has the window, was not found: expected it on the search path for programs; build it "
    "with `cargo install --locked --path .` in its repository, or name it in the environment variable SVBRDF_PROGRAM"
)
HEADLIGHT = Scene("near", view=(0, 0, 2.5), light=(0.4, 0.5, 1.2))


def show(
    ground_truth: Material | Source,
    predictions: Material | Source | Sequence[Material | Source] = (),
    *,
    scene: Scene = HEADLIGHT,
    convention: str = "printed",
    dataset: bool = False,
    results: str | os.PathLike[str] | None = None,
    wait: bool = False,
) -> "subprocess.Popen[bytes]":
    """Opens the desktop window on materials, if the program svbrdf is installed.

    The window opens a temporary session file, which names the materials and how they are read. Materials made of arrays
    are written beside it as EXR files of 32-bit floats. The files are removed when the window is closed. The
    environment variable SVBRDF_PROGRAM may name the program.

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials or paths.
        scene: The light and the view that the window starts with.
        convention: A name of `svbrdf.CONVENTIONS`.
        dataset: Whether `ground_truth` is a folder of ground truths, and each of `predictions` the folder of a method,
            as for `svbrdf.rank_dataset`. Then `scene` and `convention` are chosen in the window.
        results: The folder of losses of a data set that are known, to which the others are added.
        wait: Whether to return only when the window is closed.

    Returns:
        The process of the window.

    Raises:
        FileNotFoundError: The program is not installed. The text says how to get it.
        ValueError: `results` without `dataset`, or a data set that is no folders.
        OSError: The temporary files cannot be written.
        svbrdf.Error: There is no such convention, or a sidecar file is broken.
    """
    program = os.environ.get("SVBRDF_PROGRAM") or shutil.which("svbrdf")
    if program is None:
        raise FileNotFoundError(MISSING)
    if isinstance(predictions, Material | str | os.PathLike):
        predictions = [predictions]
    if dataset:
        return _show_dataset(program, [ground_truth, *predictions], results, wait)
    if results is not None:
        raise ValueError("expected dataset=True beside results, which are the losses of a data set")
    folder = Path(tempfile.mkdtemp(prefix="svbrdf-"))
    try:
        session = write_session(folder, [ground_truth, *predictions], scene, convention)
        window = subprocess.Popen([program, "view", "--", str(session)])
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    if wait:
        _remove_after(window, folder)
    else:
        threading.Thread(target=_remove_after, args=(window, folder), daemon=True).start()
    return window


def _show_dataset(
    program: str,
    folders: Sequence[Material | Source],
    results: str | os.PathLike[str] | None,
    wait: bool,
) -> "subprocess.Popen[bytes]":
    paths = [os.path.abspath(one) for one in folders if not isinstance(one, Material)]
    if len(paths) < max(len(folders), 2):
        raise ValueError("expected a folder of ground truths and the folder of at least one method")
    options = [] if results is None else ["--results", os.path.abspath(results)]
    window = subprocess.Popen([program, "view", "--dataset", *options, "--", *paths])
    if wait:
        window.wait()
    return window


def write_session(folder: Path, materials: Sequence[Material | Source], scene: Scene, convention: str) -> Path:
    """Writes a session file, and the materials that are not files yet, into `folder`."""
    path = folder / "python.svbrdf-session.json"
    entries = [_entry(material, folder / str(i)) for i, material in enumerate(materials)]
    path.write_text(_core.session(path, entries, (scene.kind, scene.view, scene.light), convention))
    return path


def _entry(material: Material | Source, folder: Path) -> tuple[str, str | None]:
    """The path of a material, and the options that it was read with, if it was read here."""
    if not isinstance(material, Material):
        return os.path.abspath(material), None
    if material.path is not None:
        return os.path.abspath(material.path), material._options
    folder.mkdir()
    name = "".join(c if c.isalnum() or c in " -_." else "_" for c in material.name).strip(" .") or "material"
    path = folder / f"{name}.exr"
    write(material, path, depth="float")
    # The file says itself what its values mean; where y points, the window would check.
    return str(path), '{"normal-y": "up"}'


def _remove_after(window: "subprocess.Popen[bytes]", folder: Path) -> None:
    window.wait()
    shutil.rmtree(folder, ignore_errors=True)

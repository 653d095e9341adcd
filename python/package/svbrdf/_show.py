"""The desktop window."""

import atexit
import os
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Sequence
from pathlib import Path

from ._material import Material, Source, write

MISSING = (
    "the program svbrdf, which has the window, was not found: expected it on the search path for programs; build it "
    "with `cargo install --locked --path .` in its repository, or name it in the environment variable SVBRDF_PROGRAM"
)


def show(
    ground_truth: Material | Source,
    predictions: Material | Source | Sequence[Material | Source] = (),
    *,
    wait: bool = False,
) -> "subprocess.Popen[bytes]":
    """Opens the desktop window on materials, if the program svbrdf is installed.

    Arrays are written to a temporary folder, which is removed when the window is closed. The environment variable
    SVBRDF_PROGRAM may name the program.

    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials or paths.
        wait: Whether to return only when the window is closed.

    Returns:
        The process of the window.

    Raises:
        FileNotFoundError: The program is not installed. The text says how to get it.
    """
    program = os.environ.get("SVBRDF_PROGRAM") or shutil.which("svbrdf")
    if program is None:
        raise FileNotFoundError(MISSING)
    if isinstance(predictions, Material | str | os.PathLike):
        predictions = [predictions]
    folder = Path(tempfile.mkdtemp(prefix="svbrdf-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    paths = [_path(material, folder / str(i)) for i, material in enumerate([ground_truth, *predictions])]
    window = subprocess.Popen([program, "view", "--", *paths])
    if wait:
        _remove_after(window, folder)
    else:
        threading.Thread(target=_remove_after, args=(window, folder), daemon=True).start()
    return window


def _path(material: Material | Source, folder: Path) -> str:
    if not isinstance(material, Material):
        return os.path.abspath(material)
    if material.path is not None:
        return os.path.abspath(material.path)
    folder.mkdir()
    name = "".join(c if c.isalnum() or c in " -_." else "_" for c in material.name).strip(" .") or "material"
    path = folder / f"{name}.exr"
    write(material, path, depth="float")
    return str(path)


def _remove_after(window: "subprocess.Popen[bytes]", folder: Path) -> None:
    window.wait()
    shutil.rmtree(folder, ignore_errors=True)

"""The package: version, documentation, types."""

import doctest
import importlib
import pkgutil
import subprocess
import tomllib
from importlib.metadata import version
from importlib.resources import files

import pytest
import svbrdf
from conftest import REPOSITORY

# Without the extension, and what needs PyTorch.
LEFT_OUT = ("_core", "torch", "_fused", "_kernel", "_maps")
MODULES = [module.name for module in pkgutil.iter_modules(svbrdf.__path__) if module.name not in LEFT_OUT]


def test_the_version_is_that_of_the_crate() -> None:
    crate = tomllib.loads((REPOSITORY / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    assert svbrdf.__version__ == version("svbrdf") == crate


def test_the_wheel_has_no_graphics_and_no_command_line() -> None:
    command = ["cargo", "tree", "--package=svbrdf-python", "--edges=normal", "--prefix=none", "--locked"]
    tree = subprocess.run(command, cwd=REPOSITORY, check=True, capture_output=True, text=True).stdout
    names = {line.split(" ")[0] for line in tree.splitlines()}
    assert {"svbrdf-core", "svbrdf-evaluate", "svbrdf-files", "svbrdf-page"} <= names
    assert not names & {"svbrdf", "svbrdf-gpu", "svbrdf-viewer", "wgpu", "egui", "eframe", "clap"}


@pytest.mark.parametrize("name", ["", *MODULES])
def test_the_examples_of_the_documentation_run(name: str) -> None:
    module = importlib.import_module(f"svbrdf.{name}".rstrip("."))
    assert doctest.testmod(module).failed == 0


def test_every_public_item_says_what_it_is() -> None:
    for name in svbrdf.__all__:
        item = getattr(svbrdf, name)
        assert isinstance(item, str | dict) or (item.__doc__ and item.__doc__.strip()), name


def test_the_package_is_typed() -> None:
    assert (files("svbrdf") / "py.typed").is_file()

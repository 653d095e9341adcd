"""The package: version, documentation, types."""

import doctest
import importlib
import pkgutil
import tomllib
from importlib.metadata import version
from importlib.resources import files

import pytest
import svbrdf
from conftest import REPOSITORY

MODULES = [module.name for module in pkgutil.iter_modules(svbrdf.__path__) if module.name not in ("_core", "torch")]


def test_the_version_is_that_of_the_crate() -> None:
    crate = tomllib.loads((REPOSITORY / "Cargo.toml").read_text())["package"]["version"]
    assert svbrdf.__version__ == version("svbrdf") == crate


@pytest.mark.parametrize("name", ["", *MODULES])
def test_the_examples_of_the_documentation_run(name: str) -> None:
    module = importlib.import_module(f"svbrdf.{name}".rstrip("."))
    assert doctest.testmod(module).failed == 0


def test_some_examples_run_at_all() -> None:
    modules = [importlib.import_module(f"svbrdf.{name}") for name in MODULES]
    finder = doctest.DocTestFinder()
    assert sum(len(test.examples) for module in modules for test in finder.find(module)) >= 10


def test_every_public_item_says_what_it_is() -> None:
    for name in svbrdf.__all__:
        item = getattr(svbrdf, name)
        assert isinstance(item, str | dict) or (item.__doc__ and item.__doc__.strip()), name


def test_the_package_is_typed() -> None:
    assert (files("svbrdf") / "py.typed").is_file()

"""The types of reports, from their schemas.

`cargo xtask bless types` writes them with the program that it names: `python3 report_types.py target/debug/svbrdf`.
"""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

COMMITTED = Path(__file__).parents[1] / "package" / "svbrdf" / "_reports.py"
HEAD = '''"""The types of reports: the keys of their JSON.

Generated from `svbrdf schema` by `cargo xtask bless types`: do not edit.
"""
# ruff: noqa: E501
# fmt: off

from collections.abc import Mapping
from typing import Any, Literal

from ._report import Record, Report
from ._scenes import Scene
'''
SCALARS = {"string": "str", "integer": "int", "number": "float", "boolean": "bool", "null": "None"}
WITH_ARRAYS = ("MapReport", "PhotoReport")
"""The package adds their arrays."""
OTHERS = ("info",)
"""Reports of the command line alone: the package has `Material.assumptions` and `Material.notes`."""


def module(program: str) -> str:
    """The module of the types; a class stands before those that have it."""
    classes: dict[str, str] = {}

    def add(name: str, schema: dict[str, Any], parts: dict[str, Any], base: str) -> None:
        for part in dict.fromkeys(references(schema)):
            if part != "Scene" and "properties" in parts[part]:
                add(part, parts[part], parts, "Record")
        text = class_of(name, schema, parts, base)
        if classes.setdefault(name, text) != text:
            raise ValueError(f"two classes are called {name}")

    printed = subprocess.run([program, "schema"], check=True, capture_output=True).stdout
    for command, schema in json.loads(printed).items():
        if command not in OTHERS:
            add(schema["title"], schema, schema.get("$defs", {}), "Report")
    names = "".join(f'    "{name}",\n' for name in sorted(classes) if name not in WITH_ARRAYS)
    return "\n\n".join([f"{HEAD}\n__all__ = [\n{names}]\n", *classes.values()])


def references(schema: Any) -> Iterator[str]:
    """The parts that a schema names."""
    for key, value in schema.items() if isinstance(schema, dict) else enumerate(schema):
        if key == "$ref":
            yield value.rpartition("/")[2]
        elif key != "$defs" and isinstance(value, dict | list):
            yield from references(value)


def class_of(name: str, schema: dict[str, Any], parts: dict[str, Any], base: str) -> str:
    """The class of an object."""
    required = schema.get("required", [])
    lines = [f"class {name}({base}):", docstring(schema), ""]
    for key in dict.fromkeys([*required, *schema["properties"]]):
        described = schema["properties"][key]
        kinds = dict.fromkeys([*kinds_of(described, parts), *([] if key in required else ["None"])])
        lines += [f"    {key}: {union(kinds)}", *([docstring(described)] if "description" in described else [])]
    return "\n".join(lines) + "\n"


def docstring(schema: dict[str, Any]) -> str:
    return f'    """{schema["description"].replace("null", "None").rstrip(".")}."""'


def union(kinds: dict[str, None]) -> str:
    """Types joined by `|`: words in one `Literal`, None at the end."""
    words = ", ".join(kind for kind in kinds if kind.startswith('"'))
    others = [kind for kind in kinds if not kind.startswith('"') and kind != "None"]
    return " | ".join([*others, *([f"Literal[{words}]"] if words else []), *(["None"] if "None" in kinds else [])])


def kinds_of(schema: Any, parts: dict[str, Any]) -> list[str]:
    """Every type of a schema; words are in quotation marks."""
    if "$ref" in schema:
        name = schema["$ref"].rpartition("/")[2]
        return [name] if "properties" in parts[name] else kinds_of(parts[name], parts)
    for choices in ("anyOf", "oneOf"):
        if choices in schema:
            return [kind for choice in schema[choices] for kind in kinds_of(choice, parts)]
    if words := schema.get("enum", [schema["const"]] if "const" in schema else None):
        return [json.dumps(word) for word in words]
    names = schema.get("type", [])
    return [kind(name, schema, parts) for name in ([names] if isinstance(names, str) else names)] or ["Any"]


def kind(name: str, schema: dict[str, Any], parts: dict[str, Any]) -> str:
    if name == "object":
        entry = schema["additionalProperties"]
        return f"Mapping[str, {'Any' if entry is True else union(dict.fromkeys(kinds_of(entry, parts)))}]"
    if name != "array":
        return SCALARS[name]
    item = union(dict.fromkeys(kinds_of(schema["items"], parts)))
    count = schema.get("minItems", 0) if "$ref" not in schema["items"] else 0
    return f"tuple[{', '.join([item] * count) or f'{item}, ...'}]"


if __name__ == "__main__":
    COMMITTED.write_text(module(sys.argv[1]))

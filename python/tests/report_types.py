"""The types of reports and the functions of analyses, from their schemas.

`cargo xtask bless types` writes them with the program that it names: `python3 report_types.py target/debug/svbrdf`.
"""

import json
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

PACKAGE = Path(__file__).parents[1] / "package" / "svbrdf"
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
HEAD_OF_ANALYSES = '''"""The analyses that each have one question.

Generated from `svbrdf schema` by `cargo xtask bless types`: do not edit.
"""
# ruff: noqa: E501
# fmt: off

import json
from typing import Literal

from . import _core
from ._asked import Asked, Predictions, Scenes, answered
from ._material import Material, Source
from ._progress import Report as Progress
from ._reports import {reports}
from ._scenes import check_whole

__all__ = {names}
'''
FUNCTION = '''

def {name}(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
{parameters}
    convention: str = "printed",
    progress: bool | Progress = False,
) -> {report}:
    """{about}.

{details}

{arguments}
    """
{checks}    options = json.dumps({{{options}}})
    asked = Asked(ground_truth, predictions, convention=convention, {given})
    return answered({report}, _core.analysis, asked, "{doing}", progress, "{name}", options)
'''
SCENES = {
    "seed": {"seed": "int"},
    "target_error": {"target_error": "float"},
    "sampled": {"near": "int", "distant": "int", "sampler": 'Literal["random", "sobol"]'},
    "list": {"scenes": "Scenes"},
}
OF_THE_PACKAGE = ("metrics",)
"""The package has functions of its own for these, with further arguments."""
SCALARS = {"string": "str", "integer": "int", "number": "float", "boolean": "bool", "null": "None"}
WITH_ARRAYS = ("MapReport",)
"""The package adds its arrays."""
OTHERS = ("info",)
"""Reports of the command line alone: the package has `Material.assumptions` and `Material.notes`."""


def modules(program: str) -> dict[str, str]:
    """The generated files of the package by their names."""
    printed = subprocess.run([program, "schema"], check=True, capture_output=True).stdout
    schemas = json.loads(printed)
    return {"_reports.py": types(schemas), "_analyses.py": functions(schemas)}


def functions(schemas: dict[str, Any]) -> str:
    """The module of the analyses."""
    of_analyses = {name: schema for name, schema in schemas.items() if "x-analysis" in schema}
    names = sorted(of_analyses.keys() - set(OF_THE_PACKAGE))
    reports = ", ".join(of_analyses[name]["title"] for name in names)
    listed = json.dumps(names)
    head = HEAD_OF_ANALYSES.format(reports=reports, names=listed)
    return head + "".join(function(name, of_analyses[name]) for name in names)


def function(name: str, schema: dict[str, Any]) -> str:
    """The function of an analysis."""
    analysis = schema["x-analysis"]
    own = analysis["options"].get("properties", {})
    scenes = {option: kind for group in analysis["scenes"] for option, kind in SCENES[group].items()}
    parameters = [f"    {key}: {SCALARS[option['type']]} = {option['default']}," for key, option in own.items()]
    parameters += [f"    {key}: {kind} | None = None," for key, kind in scenes.items()]
    described = {key: option["description"] for key, option in own.items()}
    arguments = "".join(f"`{key}`: {text[0].lower()}{text[1:]}. " for key, text in described.items())
    whole = [key for key, option in own.items() if option["type"] == "integer"]
    return FUNCTION.format(
        name=name,
        parameters="\n".join(parameters),
        report=schema["title"],
        about=analysis["about"].replace("Prints", "Computes"),
        details=filled(analysis["details"]),
        arguments=filled(arguments + "The other args and errors are those of `svbrdf.loss`."),
        checks="".join(f'    check_whole("{key}", {key})\n' for key in whole),
        options=", ".join(f'"{key}": {key}' for key in own),
        given=", ".join(f"{key}={key}" for key in scenes),
        doing=analysis["doing"],
    )


def filled(text: str) -> str:
    return textwrap.fill(text, 116, initial_indent="    ", subsequent_indent="    ")


def types(schemas: dict[str, Any]) -> str:
    """The module of the types; a class stands before those that have it."""
    classes: dict[str, str] = {}

    def add(name: str, schema: dict[str, Any], parts: dict[str, Any], base: str) -> None:
        for part in dict.fromkeys(references(schema)):
            if part != "Scene" and "properties" in parts[part]:
                add(part, parts[part], parts, "Record")
        text = class_of(name, schema, parts, base)
        if classes.setdefault(name, text) != text:
            raise ValueError(f"two classes are called {name}")

    for command, schema in schemas.items():
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
    for name, text in modules(sys.argv[1]).items():
        (PACKAGE / name).write_text(text)

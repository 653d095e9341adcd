"""The schemas of reports: the types that are written from them, and the JSON of the command line."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import report_types
import svbrdf
from conftest import maps


def problems(program: str, name: str, report: Any) -> list[str]:
    """What of the JSON of a report is not as its schema says, where keys that it does not name are problems, too."""
    schema = json.loads(subprocess.run([program, "schema", name], check=True, capture_output=True).stdout)
    for part in (schema, *schema.get("$defs", {}).values()):
        if "properties" in part:
            part["additionalProperties"] = False
    return [error.message for error in jsonschema.Draft202012Validator(schema).iter_errors(report)]


def test_the_types_of_reports_are_those_of_the_schemas(program: str) -> None:
    for name, text in report_types.modules(program).items():
        assert (report_types.PACKAGE / name).read_text() == text, f"{name} is stale: cargo xtask bless types"


@pytest.mark.parametrize(
    ("plant", "problem"),
    [
        (lambda report: report["results"][0].update(loss="0.1"), "'0.1' is not of type 'number'"),
        (lambda report: report["results"][1].update(los=0.1), "'los' was unexpected"),
        (lambda report: report.pop("seed"), "'seed' is a required property"),
        (lambda report: report["differences"][0].update(interval95=[1.0]), "[1.0] is too short"),
        (lambda report: report.update(sampler="halton"), "'halton' is not valid under any of the given schemas"),
        (lambda report: report["scenes"][0].update(kind="far"), "'far' is not valid under any of the given schemas"),
    ],
)
def test_a_planted_fault_is_found(program: str, plant: Callable[[Any], None], problem: str) -> None:
    ground_truth, *predictions = svbrdf.built_in()
    report = svbrdf.loss(ground_truth, predictions, near=2).to_dict()
    assert problems(program, "loss", report) == []
    plant(report)
    (found,) = problems(program, "loss", report)
    assert problem in found


def test_the_content_of_files_is_as_its_schema_says(program: str, tmp_path: Path) -> None:
    """The package has no report of it: `Material.assumptions` and `Material.notes` are its parts."""
    path = tmp_path / "a.png"
    svbrdf.write(svbrdf.Material(**maps(13, 11)), path)
    printed = subprocess.run([program, "info", path, "--format", "json"], check=True, capture_output=True).stdout
    report = json.loads(printed)
    assert len(report["maps"]) == 4
    assert len(report["assumptions"]) > 3
    assert problems(program, "info", report) == []
    report["assumptions"][0]["certainty"] = "perhaps"
    assert problems(program, "info", report) != []


def test_types_follow_schemas() -> None:
    def of(schema: dict[str, Any]) -> str:
        return report_types.union(dict.fromkeys(report_types.kinds_of(schema, {"Loss": {"properties": {}}})))

    ends = {"type": ["array", "null"], "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
    assert of(ends) == "tuple[float, float] | None"
    assert of({"type": "array", "items": {"$ref": "#/$defs/Loss"}, "minItems": 4}) == "tuple[Loss, ...]"
    assert of({"oneOf": [{"const": "a"}, {"type": "null"}, {"enum": ["b"]}]}) == 'Literal["a", "b"] | None'
    assert of({"type": "object", "additionalProperties": True}) == "Mapping[str, Any]"

"""What the tests share: arrays, the reference data beside the checkout, the program."""

import json
import os
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

try:
    import torch

    if not torch.cuda.is_available():
        # Triton reads it when it is imported.
        os.environ["TRITON_INTERPRET"] = "1"
    from svbrdf import _fused
except ImportError:
    _fused = None  # type: ignore[assignment]
import svbrdf

REPOSITORY = Path(__file__).resolve().parents[2]
GOLDEN = REPOSITORY.parent / "shared" / "golden"


def maps(height: int, width: int, seed: int = 0, dtype: Any = np.float32) -> dict[str, Any]:
    """Random maps of a material."""
    random = np.random.default_rng(seed)
    normal = random.uniform(-0.5, 0.5, (height, width, 3))
    normal[..., 2] = 1
    colours = {name: random.uniform(0, 1, (height, width, 3)).astype(dtype) for name in ("diffuse", "specular")}
    return {"normal": normal.astype(dtype), **colours, "roughness": random.uniform(0, 1, (height, width)).astype(dtype)}


def golden_materials(golden: Path, case: dict[str, Any], precision: Any) -> list[svbrdf.Material]:
    """The ground truth and the prediction of a golden loss."""

    def read(which: str) -> svbrdf.Material:
        file, albedo = golden / case[which]["file"], case[which]["albedo"]
        return svbrdf.read(file, albedo=albedo, order="ndrs", normal_y="up", roughness="r", precision=precision)

    return [read("ground_truth"), read("prediction")]


def problems(name: str, report: Any) -> list[str]:
    """What of the JSON of a report is not as its schema says, where keys that it does not name are problems, too."""
    schema = json.loads(svbrdf._core.schema(name))
    for part in (schema, *schema.get("$defs", {}).values()):
        if "properties" in part:
            part["additionalProperties"] = False
    return [error.message for error in jsonschema.Draft202012Validator(schema).iter_errors(report)]


@pytest.fixture(autouse=True)
def interpreter_is_off(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tensors of the processor take plain PyTorch, but in the tests of the kernel."""
    if _fused:
        monkeypatch.setattr(_fused, "INTERPRETED", False)


@pytest.fixture(scope="session")
def golden() -> Path:
    """The folder of the golden losses."""
    if not GOLDEN.is_dir():
        pytest.skip(f"the reference data is not beside the checkout: {GOLDEN}")
    return GOLDEN


@pytest.fixture(scope="session")
def points() -> list[dict[str, Any]]:
    """The golden points."""
    rows: list[dict[str, Any]] = json.loads((REPOSITORY / "tests" / "points.json").read_text())["rows"]
    return rows


@pytest.fixture(scope="session")
def program() -> str:
    """The command line of the same sources."""
    path = os.environ.get("SVBRDF_PROGRAM")
    if not path:
        pytest.skip("SVBRDF_PROGRAM does not name the program; python/test builds it and does")
    return path

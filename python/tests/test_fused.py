"""The fused kernel against plain PyTorch: on a card, or in float64 and float32 in Triton's interpreter."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import svbrdf
from test_torch import gradients, random_maps

if os.environ.get("SVBRDF_NEEDS_TRITON"):
    import triton  # noqa: F401
else:
    pytest.importorskip("triton", reason="Triton is not installed")
import svbrdf.torch as sv
import torch
from svbrdf import _fused

ON_CARD = torch.cuda.is_available()
DEVICE = "cuda" if ON_CARD else "cpu"
FIRST_TABLE = [name for name, one in svbrdf.CONVENTIONS.items() if not one.smith and one.norm == "log-l1"]
needs_card = pytest.mark.skipif(not ON_CARD, reason="PyTorch has no CUDA device")
needs_operators = pytest.mark.skipif(not hasattr(torch.library, "custom_op"), reason="PyTorch 2.4 has custom operators")


@pytest.fixture(autouse=True)
def interpreted(monkeypatch: pytest.MonkeyPatch, interpreter_is_off: None) -> None:
    monkeypatch.setattr(_fused, "INTERPRETED", not ON_CARD)


def moved(given: Any, dtype: Any = torch.float64) -> Any:
    return sv.Maps(*(map.to(DEVICE, dtype) for map in given))


def texels(*rows: tuple[Any, float, float, float]) -> Any:
    """A row of texels from normal, gray diffuse and specular, and roughness."""
    columns = [torch.tensor(column, dtype=torch.float64) for column in zip(*rows, strict=True)]
    normal, gray = columns[0].T[:, None], [column[None, None] for column in columns[1:]]
    return moved((normal, gray[0] * torch.tensor([[[1.0]], [[0.5]], [[0.2]]]), gray[1].repeat(3, 1, 1), gray[2]))


UP, SIDE, SLANTED = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.6, 0.0, 0.8)
STRAIGHT = [1.0, 0, 0, 1, 0, 0, 1]
ROWS = [[0.0, *UP, *UP], [0.0, *SLANTED, *UP], [0.0, -0.6, 0, 0.8, *SLANTED], STRAIGHT, [1, 0.3, -0.2, 0.05, -1, 0, 2]]
BRIGHT = [(n, 0.7, 0.6, 0.4) for n in (UP, SLANTED, SIDE, (0.1, 0.2, 0.3))]
LIMITS: dict[str, tuple[Any, Any, list[list[float]]]] = {
    "roughness at, below and beside its floor": (
        [(n, 0.5, 0.3, r) for n in (UP, (0.1, 0, 1)) for r in (0, 1e-5, 9.99e-5, 1e-4, 1e-3, 9.99e-4, 1.001e-3, 1)],
        [(UP, 0.2, 0.1, 0.5)],
        ROWS,
    ),
    "n.l, n.v and n.h at 0 and below": (
        [(n, 0.5, 0.3, r) for n in (SIDE, (-1, 0, 0), (0, 0, -1), (-0.8, 0, 0.6), (0, 1, 0)) for r in (0.05, 0.7)],
        [(UP, 0.2, 0.1, 0.5)],
        ROWS,
    ),
    "floors of D and G": (
        [(n, 0.5, 0.3, r) for n in (UP, (1, 0, 4e-4), (1, 0, 2e-3), (-1, 0, 0.7500001)) for r in (0.01, 0.03, 0.17)],
        [(UP, 0.2, 0.1, 0.5)],
        ROWS,
    ),
    "l = -v, light in and below the plane": (
        [*BRIGHT, (UP, 1, 1, 0), ((0.1, 0.2, 0.3), 1, 1, 0)],
        [(UP, 0.2, 0.1, 0.5)],
        [[0, *SLANTED, -0.6, 0, -0.8], [0, 0.6, 0.8, 0, *UP], [0, 0.6, 0, -0.8, *UP], [0, *SIDE, -1, 0, 0], STRAIGHT],
    ),
    "lights just above the plane": (
        [*BRIGHT, ((1, 0, 1), 0.7, 0.6, 0.05)],
        [(UP, 0.2, 0.1, 0.5)],
        [[0, 1, 0, z, *UP] for z in (1e-4, 1e-3, 1e-307)],
    ),
    "black texels": ([(UP, 0, 0, r) for r in (0, 0.1, 1)], [(SLANTED, 0, 0, 0.3), (UP, 0, 0, 0.1)], ROWS),
    "colours at 0 and 1": ([(UP, d, s, 0.3) for d in (0, 1) for s in (0, 1)], [(UP, 0.5, 0.5, 0.2)], ROWS),
    "equal radiances": (BRIGHT, BRIGHT, ROWS),
    "normals of any length, and none": (
        [(n, 0.5, 0.3, 0.4) for n in ((0, 0, 0), (0, 0, 7), (3, -2, 0.1), (1e-200, 0, 1e-200))],
        [((0, 0, 0), 0.2, 0.1, 0.5)],
        ROWS,
    ),
}


def pairs_of(prediction: Any, ground_truth: Any, points: Any, name: str) -> list[tuple[Any, Any]]:
    """The loss and gradients of the kernel beside those of plain PyTorch in float64."""
    one = svbrdf.CONVENTIONS[name]
    got = gradients(lambda p: _fused.fused_loss(points, one, p, ground_truth), prediction)
    wide = [sv.Maps(*(map.cpu().double() for map in maps)) for maps in (prediction, ground_truth)]
    expected = gradients(lambda p: sv._losses(p, wide[1], points.cpu(), one).mean(), wide[0])
    return [(a.cpu().double(), b) for a, b in zip((got[0], *got[1]), (expected[0], *expected[1]), strict=True)]


@pytest.mark.parametrize("convention", FIRST_TABLE)
@pytest.mark.parametrize("limit", LIMITS)
# NumPy, which interprets, warns of the radiances that are limited.
@pytest.mark.filterwarnings("ignore:overflow encountered:RuntimeWarning")
def test_loss_and_gradient_are_those_of_plain_pytorch_at_the_limits(limit: str, convention: str) -> None:
    rows, others, points = LIMITS[limit]
    given = [texels(*rows), texels(*(len(rows) * list(others))[: len(rows)])]
    pairs = pairs_of(given[0], given[1], torch.tensor(points, dtype=torch.float64), convention)
    for (got, expected), name in zip(pairs, ("loss", *sv.Maps._fields), strict=True):
        assert torch.isfinite(expected).all(), name
        worst = float(expected.abs().max())
        assert torch.allclose(got, expected, rtol=1e-9, atol=1e-12 * worst), (name, got, expected)
    assert (limit == "equal radiances") == all((got == 0).all() for got, _ in pairs[1:])


@pytest.mark.parametrize("convention", FIRST_TABLE)
def test_float32_is_within_1e_5_of_float64(convention: str) -> None:
    given = [moved(random_maps(seed, 24, 40), torch.float32) for seed in (0, 1)]
    points = sv.endpoints(svbrdf.sample_scenes(seed=2, convention=convention))
    for got, expected in pairs_of(given[0], given[1], points, convention):
        assert (got - expected).norm() <= 1e-5 * expected.norm()


def layouts() -> dict[str, tuple[Any, Any]]:
    """Predictions and ground truths of several batch dimensions and strides."""
    many = [moved(random_maps(seed)) for seed in range(7)]

    def batch(first: int, last: int, *dims: int) -> Any:
        stacked = (torch.stack(maps) for maps in zip(*many[first:last], strict=True))
        return sv.Maps(*(map.reshape(*dims, *map.shape[1:]) for map in stacked))

    two = batch(0, 2, 2)
    return {
        "no batch": (many[0], many[1]),
        "one ground truth": (batch(0, 6, 2, 3), many[6]),
        "one prediction": (many[6], batch(0, 6, 3, 2)),
        "one roughness": (two._replace(roughness=many[5].roughness), batch(3, 5, 2)),
        "channels of a network": (sv.Maps(*torch.cat(two, 1).split((3, 3, 3, 1), 1)), batch(3, 5, 2)),
        "channels last": (sv.Maps(*(m.to(memory_format=torch.channels_last) for m in two)), batch(3, 5, 2)),
        "transposed": (sv.Maps(*(m.mT for m in two)), sv.Maps(*(m.mT.contiguous() for m in batch(3, 5, 2)))),
        "one texel": (sv.Maps(*(m[..., :1, :1] for m in two)), sv.Maps(*(m[..., :1, :1] for m in many[3]))),
    }


@pytest.mark.parametrize("layout", layouts())
def test_batches_of_any_layout_have_the_loss_and_gradient_of_plain_pytorch(layout: str) -> None:
    prediction, ground_truth = layouts()[layout]
    results = []
    for fused in (True, False):
        loss = sv.RenderingLoss(straight_through=layout == "no batch", check=False, fused=fused)
        value, found = gradients(lambda p, loss=loss: 3 * loss(p, ground_truth, seed=5), prediction)
        results.append([value, *found])
        with torch.no_grad():
            torch.testing.assert_close(3 * loss(prediction, ground_truth, seed=5), value, rtol=1e-12, atol=0)
    torch.testing.assert_close(*results, rtol=1e-10, atol=1e-14)


def test_the_scenes_are_those_of_the_core_and_new_in_every_call() -> None:
    pair, loss = [moved(random_maps(seed)) for seed in (0, 1)], sv.RenderingLoss()
    arrays = [{name: map.cpu().movedim(0, -1).numpy() for name, map in maps._asdict().items()} for maps in pair]
    core = [svbrdf.Material(**{**one, "roughness": one["roughness"][..., 0]}, precision="f64") for one in arrays]
    expected = svbrdf.loss(core[1], core[0], near=6, distant=3, seed=3, precision="f64").results[0].loss
    assert loss(*pair, seed=3).item() == pytest.approx(expected, rel=1e-12)
    points = sv.endpoints(svbrdf.sample_scenes(seed=3)).to(DEVICE)
    assert loss(*pair, points=points).item() == pytest.approx(expected, rel=1e-12)
    assert sv.RenderingLoss(scenes=svbrdf.sample_scenes(seed=3))(*pair).item() == pytest.approx(expected, rel=1e-12)
    torch.manual_seed(7)
    first = [loss(*pair).item() for _ in range(3)]
    torch.manual_seed(7)
    assert [loss(*pair).item() for _ in range(3)] == first
    assert len(set(first)) == 3


def test_what_the_kernel_has_not_goes_the_plain_way_and_says_so_once() -> None:
    prediction, ground_truth = [moved(random_maps(seed)) for seed in (0, 1)]
    for loss, truth, match in (
        (sv.RenderingLoss(convention="matfuse-2024"), ground_truth, "slower: it has no .* convention `matfuse-2024`"),
        (sv.RenderingLoss(), sv.Maps(*(map.clone().requires_grad_() for map in ground_truth)), "; detach it"),
    ):
        with pytest.warns(UserWarning, match=match) as told:
            value = loss(prediction, truth, seed=1)
        assert len(told) == 1
        assert loss(prediction, truth, seed=1) == value


@pytest.mark.parametrize("fused", [True, False])
def test_second_derivatives_are_refused_by_the_name_of_what_has_them(fused: bool) -> None:
    prediction, ground_truth = [moved(random_maps(seed)) for seed in (0, 1)]
    value = sv.RenderingLoss(fused=fused)(sv.Maps(*(map.requires_grad_() for map in prediction)), ground_truth)
    (first,) = torch.autograd.grad(value, prediction.normal, create_graph=True)
    with pytest.raises(RuntimeError, match=r"first derivatives only; svbrdf.torch.scene_losses\(.*\).mean\(\) has all"):
        first.square().sum().backward()


class Trained(torch.nn.Module):  # type: ignore[misc]
    """A network and its loss."""

    def __init__(self) -> None:
        super().__init__()
        torch.manual_seed(0)
        self.network, self.loss = torch.nn.Conv2d(3, 10, 1).to(DEVICE), sv.RenderingLoss()

    def forward(self, picture: Any, ground_truth: Any, seed: int | None = None) -> Any:
        x = self.network(picture)
        normal = x[:, :3] + torch.tensor([0.0, 0.0, 2.0], device=x.device)[:, None, None]
        prediction = sv.Maps(normal, x[:, 3:6].sigmoid(), x[:, 6:9].sigmoid(), x[:, 9:].sigmoid())
        return self.loss(prediction, ground_truth, seed=seed)


def trained(compute: Any, model: Trained, seed: int | None = 1) -> list[Any]:
    picture, truth = torch.rand(2, 3, 6, 8, generator=torch.Generator().manual_seed(1)), random_maps(1)
    model.zero_grad()
    value = compute(picture.to(DEVICE), moved(truth, torch.float32), seed=seed)
    value.backward()
    return [value.detach(), model.network.weight.grad.clone()]


def test_under_autocast_the_loss_is_computed_in_float32() -> None:
    half, truth = (moved(random_maps(seed), torch.bfloat16) for seed in (0, 1))
    loss = sv.RenderingLoss(scenes=svbrdf.sample_scenes())
    with torch.autocast(DEVICE, dtype=torch.bfloat16):
        value, found = gradients(lambda p: loss(p, truth), half)
    assert value.dtype == torch.float32
    exact, expected = gradients(lambda p: loss(p, moved(truth, torch.float32)), moved(half, torch.float32))
    assert value == exact
    for got, wide in zip(found, expected, strict=True):
        torch.testing.assert_close(got, wide.bfloat16(), rtol=0, atol=0)


@needs_operators
@pytest.mark.parametrize("backend", ["eager", "aot_eager"])
def test_a_network_with_the_loss_compiles_to_one_graph(backend: str) -> None:
    torch.compiler.reset()
    model = Trained()
    compiled = torch.compile(model, backend=backend, fullgraph=True)
    for seed in (1, 2):
        for got, expected in zip(trained(compiled, model, seed), trained(model, model, seed), strict=True):
            torch.testing.assert_close(got, expected, rtol=1e-5, atol=1e-8)
    runs = []
    for compute in (compiled, model):
        torch.manual_seed(5)
        runs.append([trained(compute, model, None)[0].item() for _ in range(3)])
    assert runs[0] == pytest.approx(runs[1], rel=1e-6)
    assert len(set(runs[0])) == 3
    wrong = random_maps(1)._replace(roughness=torch.rand(3, 6, 8))
    with pytest.raises(Exception, match=r"ground_truth.roughness: expected ... x 1 x 6 x 8"):
        compiled(torch.rand(2, 3, 6, 8, device=DEVICE), moved(wrong, torch.float32))


@needs_operators
def test_data_parallel_training_has_the_same_gradient(tmp_path: Path) -> None:
    model = Trained()
    expected = trained(model, model)
    torch.distributed.init_process_group("gloo", init_method=f"file://{tmp_path}/store", rank=0, world_size=1)
    try:
        got = trained(torch.nn.parallel.DistributedDataParallel(model), model)
    finally:
        torch.distributed.destroy_process_group()
    torch.testing.assert_close(got, expected)


def test_the_kernel_compiles_for_a_card_without_one() -> None:
    """The interpreter takes what the compiler refuses. In a process of its own: this one interprets."""
    code = Path(__file__).with_name("compile_kernel.py")
    environment = {key: value for key, value in os.environ.items() if key != "TRITON_INTERPRET"}
    subprocess.run([sys.executable, code], env=environment, check=True, timeout=300)


@needs_card
@pytest.mark.filterwarnings("ignore:Synchronization debug mode is a prototype:UserWarning")
def test_no_call_waits_for_the_card() -> None:
    pair, loss = [moved(random_maps(seed), torch.float32) for seed in (0, 1)], sv.RenderingLoss()
    gradients(lambda p: loss(p, pair[1]), pair[0])
    torch.cuda.set_sync_debug_mode("error")
    try:
        value, _ = gradients(lambda p: loss(p, pair[1]), pair[0])
    finally:
        torch.cuda.set_sync_debug_mode("default")
    assert value.item() > 0


@needs_card
def test_a_cuda_graph_takes_new_scenes_from_points() -> None:
    pair, loss = [moved(random_maps(seed), torch.float32) for seed in (0, 1)], sv.RenderingLoss()
    prediction = sv.Maps(*(map.requires_grad_() for map in pair[0]))
    points = sv.endpoints(svbrdf.sample_scenes(seed=0)).to(DEVICE)
    stream, graph = torch.cuda.Stream(), torch.cuda.CUDAGraph()
    torch.cuda.synchronize()
    with torch.cuda.stream(stream):
        loss(prediction, pair[1], points=points).backward()
    torch.cuda.synchronize()
    with torch.cuda.graph(graph, stream=stream):
        with pytest.raises(RuntimeError, match="a CUDA graph repeats the scenes of its capture; give points="):
            loss(prediction, pair[1])
        value = loss(prediction, pair[1], points=points)
        value.backward()
    for seed in (1, 2):
        points.copy_(sv.endpoints(svbrdf.sample_scenes(seed=seed)))
        graph.replay()
        assert value.item() == pytest.approx(loss(*pair, seed=seed).item(), rel=1e-6)


@needs_card
def test_a_cuda_graph_repeats_the_scenes_that_a_loss_is_given() -> None:
    pair, scenes = [moved(random_maps(seed), torch.float32) for seed in (0, 1)], svbrdf.sample_scenes()
    loss = sv.RenderingLoss(scenes=scenes)
    expected, graph = loss(*pair).item(), torch.cuda.CUDAGraph()
    with torch.cuda.graph(graph):
        value = loss(*pair)
    graph.replay()
    assert value.item() == expected
    assert loss(*(sv.Maps(*(map.cpu() for map in maps)) for maps in pair)).item() == pytest.approx(expected, rel=1e-5)

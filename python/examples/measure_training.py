"""Measures what the loss of a training step costs in PyTorch, beside the plain lines that are copied for it.

python measure_training.py [BATCH ...] [--side SIDE ...] [--rounds ROUNDS]

Forward and backward of the loss of a batch of predictions, 6 + 3 scenes, float32: milliseconds, the median over rounds
in which the variants take turns, the memory of the tensors that are alive at the peak, and how many kernels a card
launches and which bytes they read and write, counted on the processor. On a CUDA card the times are those between two
events, on a card that is idle before: they contain the processor's time for the launches, as where a step waits for
the one before. In a CUDA graph there is none, nor where a network keeps the card busy. The gradient of the fused kernel
is compared with that of float64. Without a card, the times are those of 2 threads of the processor.
"""

import argparse
import math
import statistics
import time
from collections.abc import Callable, Sequence
from typing import Any

import svbrdf
import torch
from svbrdf.torch import Maps, RenderingLoss, endpoints, render
from torch.profiler import ProfilerActivity, profile
from torch.utils._python_dispatch import TorchDispatchMode

CARD = torch.cuda.is_available()
DEVICE = "cuda" if CARD else "cpu"


def dot(a: Any, b: Any) -> Any:
    """The dot product along the channels."""
    return (a * b).sum(dim=-3, keepdim=True)


def plain_render(maps: Maps, light: Any, view: Any) -> Any:
    """The radiance as it is usually written: no guards, everything anew for each material and scene."""
    normal, diffuse, specular, roughness = maps
    n, l, v = (x / dot(x, x).sqrt() for x in (normal, light, view))
    h = (l + v) / dot(l + v, l + v).sqrt()
    n_dot_l, n_dot_v, n_dot_h, v_dot_h = (dot(*pair).clamp(min=0) for pair in ((n, l), (n, v), (n, h), (v, h)))
    a = roughness.clamp(min=1e-3) ** 2
    k = a / 2
    d = (a / (n_dot_h**2 * (a**2 - 1) + 1)) ** 2 / math.pi
    g = 1 / ((n_dot_l * (1 - k) + k) * (n_dot_v * (1 - k) + k))
    f = specular + (1 - specular) * 2 ** ((-5.55473 * v_dot_h - 6.98316) * v_dot_h)
    return (f * d * g / 4 + diffuse * (1 - specular) / math.pi) * n_dot_l / l[2:3]


def plain_loss(prediction: Maps, ground_truth: Maps, scenes: Sequence[svbrdf.Scene]) -> Any:
    """The loss of `plain_render`."""
    height, width = prediction.normal.shape[-2:]
    edge = (height - 1) / (width - 1)
    x = torch.linspace(-1, 1, width, device=prediction.normal.device).expand(height, width)
    y = torch.linspace(edge, -edge, height, device=x.device)[:, None].expand(height, width)
    position = torch.stack([x, y, torch.zeros_like(x)])
    total = torch.zeros((), device=x.device)
    for kind, view, light in scenes:
        c = position if kind == "near" else torch.zeros(3, 1, 1, device=x.device)
        w_l, w_v = (torch.tensor(w, device=x.device)[:, None, None] - c for w in (light, view))
        logs = [torch.log(plain_render(maps, w_l, w_v) + 0.01) for maps in (prediction, ground_truth)]
        total = total + (logs[0] - logs[1]).abs().mean()
    return total / len(scenes)


def random_maps(batch: int, side: int, seed: int, device: str = DEVICE) -> Maps:
    """Random maps; the normals are up to 50 degrees from z."""
    generator = torch.Generator().manual_seed(seed)
    maps = [0.1 + 0.8 * torch.rand(batch, channels, side, side, generator=generator) for channels in (3, 3, 3, 1)]
    maps[0][:, :2] = 2 * maps[0][:, :2] - 1
    maps[0][:, 2] = 1
    return Maps(*(map.to(device) for map in maps))


class Counted(TorchDispatchMode):  # type: ignore[misc]
    """Counts the operations that a card launches a kernel for, and the bytes that they read and write."""

    launches, moved = 0, 0

    def __torch_dispatch__(self, operation: Any, types: Any, args: Any = (), kwargs: Any = None) -> Any:
        """Counts one operation, unless it is a view."""
        result = operation(*args, **(kwargs or {}))
        alias = operation._schema.returns[0].alias_info if operation._schema.returns else None
        if alias is None or alias.is_write:
            self.launches += 1
            tensors = [t for t in (*args, result) if isinstance(t, torch.Tensor)]
            self.moved += sum(t.numel() * t.element_size() for t in tensors)
        return result


def step(loss: Callable[..., Any], prediction: Maps, ground_truth: Maps) -> list[Any]:
    """Forward and backward: the loss and the gradients."""
    leaves = Maps(*(map.detach().requires_grad_() for map in prediction))
    value = loss(leaves, ground_truth)
    value.backward()
    return [value.detach(), *(leaf.grad for leaf in leaves)]


def counted(loss: Callable[..., Any], texels: int) -> str:
    """The launches and MB of a step, counted at 64 x 64 texels on the processor."""
    pair = [random_maps(1, 64, seed, "cpu") for seed in (1, 2)]
    with Counted() as count:
        step(loss, *pair)
    return f"{count.launches:9} {count.moved / 64**2 * texels / 1e6:9.0f}"


def milliseconds(work: Callable[[], object]) -> float:
    """The time of `work`: on a card, between two events."""
    if not CARD:
        start = time.perf_counter()
        work()
        return 1e3 * (time.perf_counter() - start)
    events = [torch.cuda.Event(enable_timing=True) for _ in range(2)]
    events[0].record()
    work()
    events[1].record()
    torch.cuda.synchronize()
    return float(events[0].elapsed_time(events[1]))


def peak(work: Callable[[], object]) -> float:
    """The memory of the tensors that `work` has at its peak, in MiB, beside those that are there before."""
    if CARD:
        torch.cuda.reset_peak_memory_stats()
        before = torch.cuda.memory_allocated()
        work()
        return float(torch.cuda.max_memory_allocated() - before) / 2**20
    with profile(activities=[ProfilerActivity.CPU], profile_memory=True) as profiled:
        work()
    events = [event for event in profiled.profiler.kineto_results.events() if event.name() == "[memory]"]
    # PyTorch 1.13 has microseconds.
    events.sort(key=lambda event: event.start_ns() if hasattr(event, "start_ns") else event.start_us())
    now, most = 0, 0
    for event in events:
        now += event.nbytes()
        most = max(most, now)
    return most / 2**20


def replayed(loss: RenderingLoss, pair: Sequence[Maps], scenes: Sequence[svbrdf.Scene]) -> Callable[[], object]:
    """A CUDA graph of a step, whose scenes can be copied into `points`."""
    points, graph, stream = endpoints(scenes).to(DEVICE), torch.cuda.CUDAGraph(), torch.cuda.Stream()
    with torch.cuda.stream(stream):
        step(lambda *maps: loss(*maps, points=points), *pair)
    torch.cuda.synchronize()
    with torch.cuda.graph(graph, stream=stream):
        step(lambda *maps: loss(*maps, points=points), *pair)
    return lambda points=points: graph.replay()  # type: ignore[misc]


def measure(batch: int, side: int, rounds: int, compiles: bool) -> None:
    """Prints the rows of a batch."""
    pair, scenes = [random_maps(batch, side, seed) for seed in (1, 2)], svbrdf.sample_scenes(6, 3)
    by_pytorch, fused = RenderingLoss(scenes=scenes, fused=False), RenderingLoss(scenes=scenes)
    sampling = RenderingLoss(check=False)
    losses: dict[str, Callable[..., Any]] = {
        "plain lines": lambda p, g: plain_loss(p, g, scenes),
        "svbrdf.torch, fused=False": by_pytorch,
    }
    counts = {name: counted(loss, batch * side**2) for name, loss in losses.items()}
    if hasattr(torch, "compile") and compiles:
        torch.compiler.reset()
        plain_compiled = torch.compile(plain_loss)
        losses["plain lines, compiled"] = lambda p, g: plain_compiled(p, g, scenes)
        losses["svbrdf.torch, fused=False, compiled"] = torch.compile(by_pytorch)
    # The scenes in float32, the kernel, the sum over its programs, and the product with the factor of the loss; the
    # kernel reads 20 values of a texel and writes 10, which the product reads and writes. New scenes are copied before.
    for name, launches in ("svbrdf.torch, fused", 4), ("svbrdf.torch, fused, new scenes", 5):
        counts[name] = f"{launches:9} {batch * side**2 * 200 / 1e6:9.0f}"
    if CARD:
        losses["svbrdf.torch, fused"] = fused
    found = {name: step(loss, *pair) for name, loss in losses.items()}
    assert all(math.isclose(one[0], found["plain lines"][0], rel_tol=1e-4) for one in found.values()), found
    work: dict[str, Callable[[], object]] = {
        name: lambda loss=loss: step(loss, *pair)  # type: ignore[misc]
        for name, loss in losses.items()
    }
    if CARD:
        work["svbrdf.torch, fused, new scenes"] = lambda: step(sampling, *pair)
        work["svbrdf.torch, fused, CUDA graph"] = replayed(fused, pair, scenes)
    times = {name: [milliseconds(one) for _ in range(3)][3:] for name, one in work.items()}
    for _ in range(rounds):
        for name, one in work.items():
            times[name].append(milliseconds(one))
    print(f"batch of {batch}, {side} x {side} {'':23} {'ms':>9} {'MiB':>8} {'launches':>9} {'MB':>9}")
    for name in dict.fromkeys((*work, *counts)):
        row = f"{statistics.median(times[name]):9.3f} {peak(work[name]):8.0f}" if name in work else f"{'-':>9} {'-':>8}"
        print(f"{name:40} {row} {counts.get(name, '')}")
    if CARD:
        wide = [Maps(*(map.double() for map in maps)) for maps in pair]
        exact, smooth = step(by_pytorch, *wide), away_from_kinks(wide, scenes)
        print(f"the kernel against float64: loss {relative(found['svbrdf.torch, fused'][0], exact[0]):.1e}")
        for where, weight in ("all texels", 1), (f"the {smooth.double().mean():.4%} away from kinks", smooth):
            apart = [
                relative(a * weight, b * weight)
                for a, b in zip(found["svbrdf.torch, fused"][1:], exact[1:], strict=True)
            ]
            print(f"  gradients, {where}: " + ", ".join(f"{one:.1e}" for one in apart))


def relative(a: Any, b: Any) -> float:
    """The norm of the difference of tensors, relative to the second."""
    return float((a - b).norm() / b.norm())


def away_from_kinks(pair: Sequence[Maps], scenes: Sequence[svbrdf.Scene]) -> Any:
    """The texels where no radiance is within 1e-5 of that of the ground truth and not the same: there signs change."""
    one = svbrdf.CONVENTIONS["printed"]
    far = []
    for scene in scenes:
        logs = [torch.log(render(maps, scene, one) + one.epsilon) for maps in pair]
        apart = (logs[0] - logs[1]).abs()
        far.append(((apart == 0) | (apart > 1e-5)).all(dim=-3, keepdim=True))
    return torch.stack(far).all(dim=0)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("batch", nargs="*", type=int, default=[8] if CARD else [1, 8])
parser.add_argument("--side", nargs="+", type=int, default=[256, 512] if CARD else [256])
parser.add_argument("--rounds", type=int, default=16)
parsed = parser.parse_args()
torch.set_num_threads(2)
where = (
    torch.cuda.get_device_name() if CARD else "no CUDA card: the processor; the fused kernel is counted, not measured"
)
print(f"PyTorch {torch.__version__}, {where}")
for side in parsed.side:
    for batch in parsed.batch:
        # Compiling takes most of the time.
        measure(batch, side, parsed.rounds, compiles=side == parsed.side[0])

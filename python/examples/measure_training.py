"""Measures what the loss of a training step costs in PyTorch, beside the plain lines that are copied for it.

python measure_training.py [BATCH ...]

Forward and backward of the loss of a batch of predictions at 256 x 256, 6 + 3 scenes, 2 threads, float32: milliseconds,
the median over rounds in which the variants take turns, and the memory of the tensors that are alive at the peak.
"""

import argparse
import math
import statistics
import time
from collections.abc import Callable, Sequence
from typing import Any

import svbrdf
import torch
from svbrdf.torch import Maps, RenderingLoss
from torch.profiler import ProfilerActivity, profile


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
    x = torch.linspace(-1, 1, width).expand(height, width)
    y = torch.linspace(edge, -edge, height)[:, None].expand(height, width)
    position = torch.stack([x, y, torch.zeros_like(x)])
    total = torch.zeros(())
    for kind, view, light in scenes:
        c = position if kind == "near" else torch.zeros(3, 1, 1)
        w_l, w_v = (torch.tensor(w)[:, None, None] - c for w in (light, view))
        logs = [torch.log(plain_render(maps, w_l, w_v) + 0.01) for maps in (prediction, ground_truth)]
        total = total + (logs[0] - logs[1]).abs().mean()
    return total / len(scenes)


def random_maps(batch: int, side: int, seed: int, requires_grad: bool) -> Maps:
    """Random maps; the normals are up to 50 degrees from z."""
    generator = torch.Generator().manual_seed(seed)
    maps = [0.1 + 0.8 * torch.rand(batch, channels, side, side, generator=generator) for channels in (3, 3, 3, 1)]
    maps[0][:, :2] = 2 * maps[0][:, :2] - 1
    maps[0][:, 2] = 1
    return Maps(*(map.requires_grad_(requires_grad) for map in maps))


def peak(work: Callable[[], object]) -> float:
    """The memory of the tensors that `work` has at its peak, in MiB, beside those that are there before."""
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


def measure(batch: int, side: int, rounds: int) -> None:
    """Prints the rows of a batch."""
    prediction, ground_truth = random_maps(batch, side, 1, True), random_maps(batch, side, 2, False)
    scenes = svbrdf.sample_scenes(6, 3)
    ours = RenderingLoss(scenes=scenes)
    losses: dict[str, Callable[[], Any]] = {
        "plain lines": lambda: plain_loss(prediction, ground_truth, scenes),
        "svbrdf.torch": lambda: ours(prediction, ground_truth),
    }
    if hasattr(torch, "compile"):
        torch.compiler.reset()
        plain_compiled, compiled = torch.compile(plain_loss), torch.compile(ours)
        losses["plain lines, compiled"] = lambda: plain_compiled(prediction, ground_truth, scenes)
        losses["svbrdf.torch, compiled"] = lambda: compiled(prediction, ground_truth)

    def step(loss: Callable[[], Any]) -> float:
        for map in prediction:
            map.grad = None
        value = loss()
        value.backward()
        return float(value.item())

    values = {name: step(loss) for name, loss in losses.items()}
    expected = values["plain lines"]
    assert all(math.isclose(value, expected, rel_tol=1e-4) for value in values.values()), values
    times: dict[str, list[float]] = {name: [] for name in losses}
    for _ in range(rounds):
        for name, loss in losses.items():
            start = time.perf_counter()
            step(loss)
            times[name].append(1e3 * (time.perf_counter() - start))
    for name, loss in losses.items():
        print(f"batch of {batch}, {name:24} {statistics.median(times[name]):8.1f} {peak(lambda: step(loss)):8.0f}")  # noqa: B023


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("batch", nargs="*", type=int, default=[1, 8])
torch.set_num_threads(2)
print(f"PyTorch {torch.__version__}\n{'':34} {'ms':>9} {'MiB':>8}")
for batch in parser.parse_args().batch:
    measure(batch, side=256, rounds=16)

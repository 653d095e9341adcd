"""Measures how well few scenes estimate the gradient of the loss along roughness, and how it falls with roughness.

python measure_gradient.py [SEEDS]

Flat, gray materials (specular 0.04) of 32 x 32 texels with one roughness r, float64, convention printed.
"""

import argparse
from typing import Any

import svbrdf
import torch
from svbrdf.torch import Maps, RenderingLoss

SIDE = 32
SMALL = (0.1, 0.05, 0.02, 0.01)


def flat(diffuse: float, roughness: Any) -> Maps:
    """A material; `roughness` is a tensor of one number."""
    planes = torch.ones(1, SIDE, SIDE, dtype=torch.float64)
    rgb = planes.expand(3, -1, -1)
    return Maps(torch.cat([0 * planes, 0 * planes, planes]), diffuse * rgb, 0.04 * rgb, roughness * planes)


def gradient(loss: RenderingLoss, diffuse: float, roughness: tuple[float, float], seed: int) -> float:
    """The derivative dL/dr along the roughness r of the prediction, in the scenes of a seed.

    `roughness` is that of the ground truth, then that of the prediction.
    """
    expected, r = (torch.tensor(value, dtype=torch.float64) for value in roughness)
    loss(flat(diffuse, r.requires_grad_()), flat(diffuse, expected), seed=seed).backward()
    return float(r.grad)


def measure_scenes(diffuse: float, near: int, distant: int, seeds: int) -> None:
    """Prints a row: dL/dr at r = 0.4 against 0.05, over seeds."""
    loss = RenderingLoss(near=near, distant=distant)
    found = torch.tensor([gradient(loss, diffuse, (0.05, 0.4), seed) for seed in range(seeds)], dtype=torch.float64)
    mean, deviation = found.mean().item(), found.std().item()
    wrong = (found * mean < 0).double().mean().item()
    print(f"{diffuse:7} {near:4} + {distant:<4} {mean:9.4f} {deviation / mean:18.2f} {100 * wrong:11.1f}%", flush=True)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("seeds", nargs="?", type=int, default=500)
given = parser.parse_args()
torch.set_num_threads(1)
print(f"svbrdf {svbrdf.__version__}, PyTorch {torch.__version__}")
print(f"\nr 0.05 predicted as 0.4, {given.seeds} seeds: dL/dr")
print(f"{'diffuse':7} {'scenes':>11} {'mean':>9} {'deviation / mean':>18} {'wrong sign':>12}")
for diffuse in (0.2, 0.5):
    for near, distant in ((6, 3), (60, 30)):
        measure_scenes(diffuse, near, distant, given.seeds)
print("\ndiffuse 0.5, r 0.3 predicted as less, 600 + 300 scenes of seed 0: dL/dr")
many = RenderingLoss(near=600, distant=300)
for small in SMALL:
    print(f"r {small:<8g} {gradient(many, 0.5, (0.3, small), 0):9.1e}", flush=True)

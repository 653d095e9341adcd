"""LPIPS of renderings of predictions, which svbrdf does not compute: its weights come with the package `lpips`.

    python lpips_of_renderings.py gt.png a.png b.png --lights hemisphere --exposure 1

Needs lpips and PyTorch, which download the weights of the network once. Without materials it takes the built-in ones.
"""

# %% Materials and scenes: sampled as the papers do, or a set with a name
import argparse
from pathlib import Path

import lpips
import numpy as np
import svbrdf
import torch

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("materials", nargs="*", type=Path, help="the ground truth, then predictions")
arguments.add_argument("--lights", choices=["papers", "flash", "flash-9", "hemisphere"], default="papers")
arguments.add_argument("--exposure", type=float, default=0.0, help="in stops")
arguments.add_argument("--net", choices=["alex", "vgg", "squeeze"], default="alex")
options = arguments.parse_args()

materials = [svbrdf.read(path) for path in options.materials] or svbrdf.built_in()
if options.lights == "papers":
    scenes = svbrdf.sample_scenes(near=128, distant=64, sampler="sobol")
else:
    scenes = svbrdf.named_scenes(options.lights)


# %% Pictures: exposed, clipped, sRGB, from -1 to 1 as the network takes them
def picture(material: svbrdf.Material, scene: svbrdf.Scene) -> torch.Tensor:
    """1 x 3 x height x width."""
    linear = np.clip(svbrdf.render(material, scene) * 2.0**options.exposure, 0.0, 1.0)
    stored = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    return torch.from_numpy(2.0 * stored.astype(np.float32) - 1.0).permute(2, 0, 1)[None]


# %% The mean over the scenes, of every prediction
network = lpips.LPIPS(net=options.net)
with torch.no_grad():
    truths = [picture(materials[0], scene) for scene in scenes]
    for prediction in materials[1:]:
        distances = [
            network(truth, picture(prediction, scene)).item() for truth, scene in zip(truths, scenes, strict=True)
        ]
        print(f"{prediction.name}: LPIPS ({options.net}) {np.mean(distances):.6f} over {len(scenes)} scenes")

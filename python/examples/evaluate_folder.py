"""Evaluates every prediction in a folder and plots the losses with their intervals.

    python evaluate_folder.py gt.png predictions/ --target-error 0.01 -o losses.png

Needs matplotlib. Without arguments it evaluates the built-in materials.
"""

# %% Materials: a ground truth, and one prediction per file or folder
import argparse
from pathlib import Path

import matplotlib as mpl
import svbrdf

mpl.use("Agg")
import matplotlib.pyplot as plt

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("ground_truth", nargs="?", type=Path)
arguments.add_argument("predictions", nargs="?", type=Path)
arguments.add_argument("--target-error", type=float, default=0.01)
arguments.add_argument("-o", "--output", type=Path, default=Path("losses.png"))
options = arguments.parse_args()

if options.ground_truth is None or options.predictions is None:
    ground_truth, *predictions = svbrdf.built_in()
else:
    ground_truth = svbrdf.read(options.ground_truth)
    predictions = [svbrdf.read(path) for path in sorted(options.predictions.iterdir()) if path.suffix != ".json"]

# %% Losses: as many scenes as the accuracy needs
report = svbrdf.loss(ground_truth, predictions, target_error=options.target_error)
print(report)

# %% Plot: best first
results = sorted(report.results, key=lambda result: result.loss)
names = [result.prediction for result in results]
losses = [result.loss for result in results]
errors = [
    (result.loss - result.interval95[0], result.interval95[1] - result.loss) if result.interval95 else (0.0, 0.0)
    for result in results
]
figure, axes = plt.subplots(figsize=(6, 1 + 0.4 * len(names)), layout="constrained")
axes.barh(names, losses, xerr=list(zip(*errors, strict=True)), capsize=3, color="#4c78a8")
axes.invert_yaxis()
axes.set_xlabel(f"rendering loss against {report.ground_truth}, 95% interval")
figure.savefig(options.output, dpi=150)
print(f"wrote {options.output}")

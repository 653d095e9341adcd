"""Rendering and rendering loss of SVBRDF materials.

A material is four maps: normal, diffuse, specular and roughness. The rendering loss of Deschaintre et al. (2018-2020)
compares renderings of predictions with renderings of the ground truth in sampled scenes:

>>> import svbrdf
>>> ground_truth, *predictions = svbrdf.built_in()
>>> report = svbrdf.loss(ground_truth, predictions)
>>> print(f"{report.loss:.4f}")
0.3712
>>> report.results[1].prediction
'wrong roughness'

The numbers are those of the command line `svbrdf loss`, bit for bit. `svbrdf.torch` has the same loss for training.
"""

from ._blame import Attribution, Estimate, MapShare, blame
from ._core import Error, __version__
from ._dataset import DatasetLoss, DatasetReport, MethodSummary, MetricSummary, rank_dataset
from ._loss import Difference, Loss, LossReport, Place, loss, rank
from ._material import Assumption, AssumptionWarning, Material, built_in, read, write
from ._scenes import CONVENTIONS, Convention, Scene, read_scenes, render, sample_scenes
from ._show import show

__all__ = [
    "CONVENTIONS",
    "Assumption",
    "AssumptionWarning",
    "Attribution",
    "Convention",
    "DatasetLoss",
    "DatasetReport",
    "Difference",
    "Error",
    "Estimate",
    "Loss",
    "LossReport",
    "MapShare",
    "Material",
    "MethodSummary",
    "MetricSummary",
    "Place",
    "Scene",
    "__version__",
    "blame",
    "built_in",
    "loss",
    "rank",
    "rank_dataset",
    "read",
    "read_scenes",
    "render",
    "sample_scenes",
    "show",
    "write",
]

"""Rendering and rendering loss of SVBRDF materials.

A material is four maps: normal, diffuse, specular and roughness. The rendering loss of Deschaintre et al. (2018-2020)
compares renderings of predictions with renderings of the ground truth in sampled scenes:

>>> import svbrdf
>>> ground_truth, *predictions = svbrdf.built_in()
>>> report = svbrdf.loss(ground_truth, predictions)
>>> print(f"{report.results[0].loss:.2f}")
0.32
>>> report.results[1].prediction
'wrong roughness'

Results print as the tables of the command line, and have `to_dict()`, its JSON, and `to_pandas()`, its CSV. The numbers
are those of the command line, bit for bit. `svbrdf.torch` has the same loss for training.
"""

from . import _analyses, _reports
from ._analyses import *  # noqa: F403
from ._core import Error, __version__
from ._dataset import rank_dataset
from ._map import MapReport
from ._material import Assumption, AssumptionWarning, Material, ReadOptions, built_in, read, write
from ._report import Record, Report
from ._reports import *  # noqa: F403
from ._scenes import CONVENTIONS, Convention, Scene, named_scenes, read_scenes, render, sample_scenes

__all__ = [
    "CONVENTIONS",
    "Assumption",
    "AssumptionWarning",
    "Convention",
    "Error",
    "MapReport",
    "Material",
    "ReadOptions",
    "Record",
    "Report",
    "Scene",
    "__version__",
    "built_in",
    "named_scenes",
    "rank_dataset",
    "read",
    "read_scenes",
    "render",
    "sample_scenes",
    "write",
]
__all__ += _analyses.__all__ + _reports.__all__

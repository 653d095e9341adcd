"""Rendering and rendering loss of SVBRDF materials.

A material is four maps: normal, diffuse, specular and roughness. The rendering loss of Deschaintre et al. (2018-2020)
compares renderings of predictions with renderings of the ground truth in sampled scenes:

>>> import svbrdf
>>> ground_truth, *predictions = svbrdf.built_in()
>>> report = svbrdf.loss(ground_truth, predictions)
>>> print(f"{report.loss:.2f}")
0.32
>>> report.results[1].prediction
'wrong roughness'

Results print as the tables of the command line, and have `to_dict()`, its JSON, and `to_pandas()`, its CSV. The numbers
are those of the command line, bit for bit. `svbrdf.torch` has the same loss for training.
"""

from ._assumptions import Assumption, AssumptionWarning
from ._blame import Attribution, BlameReport, MapShare, blame
from ._capture import (
    CaptureMeans,
    CaptureMeasure,
    CaptureOutlier,
    CapturePhotograph,
    CaptureReport,
    CaptureResult,
    capture,
)
from ._core import Error, __version__
from ._dataset import DatasetLoss, DatasetReport, MarkSummary, MethodSummary, MetricSummary, rank_dataset
from ._diagnose import DiagnoseReport, Diagnosis, Finding, diagnose
from ._loss import Difference, FewScenes, Loss, LossReport, RankedPrediction, RankReport, loss, rank
from ._material import Material, built_in, read, write
from ._metrics import Metrics, MetricsReport, metrics
from ._page import Figure, figure, report
from ._photo import PhotoReport, PhotoResult, PhotoStatistics, photo
from ._report import Estimate, Report
from ._scenes import CONVENTIONS, Convention, Scene, named_scenes, read_scenes, render, sample_scenes
from ._show import show
from ._why import MapReport, MapSummary, ScenesLoss, ScenesReport, Worst, WorstReport, map, scenes, worst

__all__ = [
    "CONVENTIONS",
    "Assumption",
    "AssumptionWarning",
    "Attribution",
    "BlameReport",
    "CaptureMeans",
    "CaptureMeasure",
    "CaptureOutlier",
    "CapturePhotograph",
    "CaptureReport",
    "CaptureResult",
    "Convention",
    "DatasetLoss",
    "DatasetReport",
    "DiagnoseReport",
    "Diagnosis",
    "Difference",
    "Error",
    "Estimate",
    "FewScenes",
    "Figure",
    "Finding",
    "Loss",
    "LossReport",
    "MapReport",
    "MapShare",
    "MapSummary",
    "MarkSummary",
    "Material",
    "MethodSummary",
    "MetricSummary",
    "Metrics",
    "MetricsReport",
    "PhotoReport",
    "PhotoResult",
    "PhotoStatistics",
    "RankReport",
    "RankedPrediction",
    "Report",
    "Scene",
    "ScenesLoss",
    "ScenesReport",
    "Worst",
    "WorstReport",
    "__version__",
    "blame",
    "built_in",
    "capture",
    "diagnose",
    "figure",
    "loss",
    "map",
    "metrics",
    "named_scenes",
    "photo",
    "rank",
    "rank_dataset",
    "read",
    "read_scenes",
    "render",
    "report",
    "sample_scenes",
    "scenes",
    "show",
    "worst",
    "write",
]

"""Methods over a data set of materials."""

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from . import _core
from ._asked import Scenes, question
from ._material import Source
from ._progress import Report as Progress
from ._progress import reported
from ._report import report_of
from ._reports import DatasetReport
from ._scenes import SETS, named_scenes


def rank_dataset(
    ground_truths: Source,
    methods: Source | Sequence[Source] | Mapping[str, Source],
    *,
    target_error: float | None = None,
    near: int | None = None,
    distant: int | None = None,
    seed: int | None = None,
    sampler: Literal["random", "sobol"] | None = None,
    scenes: Scenes | None = None,
    convention: str = "printed",
    pick: Literal["fixed", "mean", "best"] = "fixed",
    strict: bool = False,
    metrics: bool = False,
    diagnose: bool = False,
    results: Source | None = None,
    read_ground_truth: Mapping[str, Any] | None = None,
    read_predictions: Mapping[str, Any] | None = None,
    read_methods: Mapping[str, Mapping[str, Any]] | None = None,
    progress: bool | Progress = False,
) -> DatasetReport:
    """Compares methods over a data set: `svbrdf rank --dataset`, with the same numbers.

    Materials of the same name in the folders belong together. `name_0`, `name_1` and so on in the folder of a method
    are several predictions of one material. A file that cannot be read is a result with its error, and not fatal.
    Materials are compared in parallel.

    Args:
        ground_truths: The folder of the ground truths.
        methods: The folder of each method, or folders by the name of the method. A path with `{}` is a pattern, in
            which `{}` stands for the name of a material: "out/{}_pred.png".
        target_error: As many scenes for each material as this relative error of every loss needs at 95% confidence;
            0.01 where nothing else decides the scenes.
        near: The number of near-field scenes of each material, as in `svbrdf.loss`.
        distant: The number of distant scenes of each material.
        seed: Names the sampled scenes, together with the name of the material; 0 where not given.
        sampler: "random", the default with `near` or `distant`, or "sobol".
        scenes: These scenes for all materials, or those of a scene file. For a list the command that repeats the
            ranking says `--scenes SCENES.json`, unless `svbrdf.named_scenes` makes it without a `fov`.
        convention: A name of `svbrdf.CONVENTIONS`.
        pick: Which of several predictions counts: the first, the mean of their losses, or the best.
        strict: Whether guesses in reading are errors.
        metrics: Whether to compute metrics of the maps, too: RMSE, L1, angles and SSIM. docs/metrics.md defines them.
        diagnose: Whether to mark what an error of exposure, alignment or reading explains of each loss, as
            `svbrdf.diagnose` does, and the losses that the ground truth does not resolve.
        results: A folder of losses: those that are in it are used, and the others are added as they come. It is the
            folder of `svbrdf rank --dataset --results`.
        read_ground_truth: Options of `svbrdf.read` for the ground truths, such as `{"albedo": "srgb"}`.
        read_predictions: The same for the predictions.
        read_methods: The same for the predictions of some methods, by name: `{"ours": {"normal_y": "down"}}`. They
            replace those of `read_predictions`.
        progress: True for a bar of tqdm, or a function of (materials done, materials in all).

    Warns:
        UserWarning: Files were read on an assumption that is in doubt: one warning for each method, and one for the
            ground truths. `DatasetReport.results` has every assumption. A file of `results` is damaged.

    Raises:
        OSError: A folder cannot be read, or the folder of results cannot be written.
        svbrdf.Error: A folder has no materials, or an option has no such value or is not used.
        TypeError, ValueError: An argument has a wrong type or makes no sense.
    """
    sampled = {"near": near, "distant": distant, "sampler": sampler}
    asked = {
        "ground_truths": ground_truths,
        "methods": _named(methods),
        "question": question(scenes, target_error=target_error, seed=seed, **sampled),
        "scenes": [*_words(sampled), *_source(scenes)],
        "convention": convention,
        "pick": pick,
        "strict": strict,
        "metrics": metrics,
        "diagnose": diagnose,
        "results": results,
        "read": [_options(given) for given in (read_ground_truth, read_predictions)],
        "read_methods": {name: _options(given) for name, given in (read_methods or {}).items()},
    }
    with reported("comparing materials", progress) as report:
        found = _core.rank_dataset(asked, report)
    return report_of(DatasetReport, found)


def _named(methods: Source | Sequence[Source] | Mapping[str, Source]) -> list[tuple[str, str]]:
    if isinstance(methods, Mapping):
        named = [(name, os.fspath(folder)) for name, folder in methods.items()]
    else:
        folders = [methods] if isinstance(methods, str | os.PathLike) else list(methods)
        paths = [os.fspath(folder) for folder in folders]
        names = _core.distinct_names([(Path(path).name or path, path) for path in paths])
        named = list(zip(names, paths, strict=True))
    if not named:
        raise ValueError("methods: expected at least one folder, found none")
    return named


def _words(sampled: Mapping[str, object]) -> list[str]:
    return [word for name, value in sampled.items() if value is not None for word in (f"--{name}", str(value))]


def _source(scenes: Scenes | None) -> list[str]:
    """The options of the command line for scenes."""
    if scenes is None:
        return []
    if isinstance(scenes, str | os.PathLike):
        return ["--scenes", os.fspath(scenes)]
    named = (name for name in SETS if named_scenes(name) == list(scenes))
    return next((["--lights", name] for name in named), ["--scenes", "SCENES.json"])


def _options(given: Mapping[str, Any] | None) -> str:
    return json.dumps({name.replace("_", "-"): value for name, value in (given or {}).items()})

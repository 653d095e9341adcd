"""Methods over a data set of materials."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal, Unpack

from . import _core
from ._asked import Accuracy, question_json
from ._material import ReadOptions, Source, options_json
from ._progress import Report as Progress
from ._progress import reported
from ._report import report_of
from ._reports import DatasetReport


def rank_dataset(
    ground_truths: Source,
    methods: Source | Sequence[Source] | Mapping[str, Source],
    *,
    convention: str = "printed",
    pick: Literal["fixed", "mean", "best"] = "fixed",
    strict: bool = False,
    metrics: bool | Sequence[str] = False,
    protocol: Source | None = None,
    register: str | Mapping[str, str] | None = None,
    mask: Source | None = None,
    common: bool = False,
    diagnose: bool = False,
    results: Source | None = None,
    read_ground_truth: ReadOptions | None = None,
    read_predictions: ReadOptions | None = None,
    read_methods: Mapping[str, ReadOptions] | None = None,
    progress: bool | Progress = False,
    **question: Unpack[Accuracy],
) -> DatasetReport:
    """Compares methods over a data set: `svbrdf rank --dataset`, with the same numbers.

    Materials of the same name in the folders belong together. `name_0`, `name_1` and so on in the folder of a method
    are several predictions of one material. A file that cannot be read is a result with its error, and not fatal.
    Materials are compared in parallel.

    Args:
        ground_truths: The folder of the ground truths.
        methods: The folder of each method, or folders by the name of the method. A path with `{}` is a pattern, in
            which `{}` stands for the name of a material: "out/{}_pred.png".
        convention: A name of `svbrdf.CONVENTIONS`.
        pick: Which of several predictions counts: the first, the mean of their losses, or the best.
        strict: Whether guesses in reading are errors.
        metrics: Whether to compute metrics of the maps, too: RMSE, L1, angles and SSIM; or words of their names, such
            as `["rmse_normal", "psnr"]`. docs/metrics.md defines them.
        protocol: The name of a protocol, such as "weiyi", or its .toml file. It decides reading, registration, mask,
            scenes, convention and metrics; what `read_ground_truth` and the like specify counts before it.
        register: How predictions of another size lie on their ground truths, such as "centre-crop", or that by the name
            of a method; None: found by the maps.
        mask: "alpha" compares only the texels that are opaque in the alpha of the ground truth; the path of a picture
            those that are white in it, where `{}` stands for the name of the material: "masks/{}.png".
        common: Whether to compare all methods over the materials that all have.
        diagnose: Whether to mark what an error of exposure, alignment or reading explains of each loss, as
            `svbrdf.diagnose` does, and the losses that the ground truth does not resolve.
        results: A folder of losses: those that are in it are used, and the others are added as they come. It is the
            folder of `svbrdf rank --dataset --results`.
        read_ground_truth: Options of `svbrdf.read` for the ground truths, such as `{"albedo": "srgb"}`.
        read_predictions: The same for the predictions.
        read_methods: The same for the predictions of some methods, by name: `{"ours": {"normal_y": "down"}}`. They
            replace those of `read_predictions`.
        progress: True for a bar of tqdm, or a function of (materials done, materials in all).
        **question: The scenes of each material, as in `svbrdf.rank`; the seed names them together with the name of the
            material. For a list of scenes the command that repeats the ranking says `--scenes SCENES.json`, unless
            `svbrdf.named_scenes` makes it.

    Warns:
        UserWarning: Files were read on an assumption that is in doubt: one warning for each method, and one for the
            ground truths. `DatasetReport.results` has every assumption. A file of `results` is damaged.

    Raises:
        OSError: A folder cannot be read, or the folder of results cannot be written.
        svbrdf.Error: A folder has no materials, or an option has no such value or is not used.
        TypeError, ValueError: An argument has a wrong type or makes no sense.
    """
    named = _named(methods)
    names = [name for name, _ in named]
    ways = dict.fromkeys(names, register) if isinstance(register, str) else dict(register or {})
    if unknown := [name for name in ways if name not in names]:
        raise ValueError(f"register: no method is named {unknown[0]}; the names are {', '.join(names)}")
    asked = {
        "ground_truths": ground_truths,
        "methods": named,
        "question": question_json(**question),
        "convention": convention,
        "pick": pick,
        "strict": strict,
        "metrics": None if metrics is False else [] if metrics is True else list(metrics),
        "protocol": None if protocol is None else os.fspath(protocol),
        "register": ways,
        "mask": None if mask is None else os.fspath(mask),
        "common": common,
        "diagnose": diagnose,
        "results": results,
        "read": [options_json(given or {}) for given in (read_ground_truth, read_predictions)],
        "read_methods": {name: options_json(given) for name, given in (read_methods or {}).items()},
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

"""Measures what a call from Python costs beside the computation of the core.

python measure_overhead.py
"""

import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import svbrdf


def milliseconds(work: Callable[[], object], rounds: int) -> tuple[float, float]:
    """The least and the median time of a call."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - start))
    return min(times), statistics.median(times)


def maps(side: int, planar: bool) -> dict[str, Any]:
    """Random maps, with channels last, or with channels first and moved to the end as those of tensors are."""
    random = np.random.default_rng(0)

    def colour() -> Any:
        values = random.uniform(0.1, 0.9, (3, side, side)).astype(np.float32)
        return values.transpose(1, 2, 0) if planar else np.ascontiguousarray(values.transpose(1, 2, 0))

    roughness = random.uniform(0.1, 0.9, (side, side)).astype(np.float32)
    return {"normal": colour(), "diffuse": colour(), "specular": colour(), "roughness": roughness}


def show(what: str, work: Callable[[], object], rounds: int) -> None:
    """Prints a row."""
    least, median = milliseconds(work, rounds)
    print(f"{what:60} {least:9.3f} {median:9.3f}")


print(f"{'milliseconds':60} {'least':>9} {'median':>9}")
texel = svbrdf.Material(**maps(1, planar=False))
scenes = svbrdf.sample_scenes(6, 3)
# Of one texel the core has next to nothing to compute: what is left is the call.
show("svbrdf.loss, 1 x 1 texels, 9 listed scenes", lambda: svbrdf.loss(texel, texel, scenes=scenes), 500)
show("svbrdf.sample_scenes(6, 3)", lambda: svbrdf.sample_scenes(6, 3), 500)
for side, rounds in ((256, 100), (2048, 5)):
    size = f"{side} x {side}"
    last, first = maps(side, planar=False), maps(side, planar=True)
    show(f"{size}: copying the arrays in NumPy", lambda given=last: [m.copy() for m in given.values()], rounds)  # type: ignore[misc]
    show(f"{size}: svbrdf.Material, channels last", lambda given=last: svbrdf.Material(**given), rounds)  # type: ignore[misc]
    show(f"{size}: svbrdf.Material, channels first", lambda given=first: svbrdf.Material(**given), rounds)  # type: ignore[misc]
    a, b = svbrdf.Material(**last), svbrdf.Material(**first)
    listed = lambda a=a, b=b: svbrdf.loss(a, b, scenes=scenes)  # noqa: E731
    show(f"{size}: svbrdf.loss, 9 listed scenes", listed, max(5, rounds // 5))

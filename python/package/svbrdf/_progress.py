"""Progress of long operations as a bar."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Report = Callable[[int, int], object]


@contextmanager
def reported(title: str, progress: bool | Report) -> Iterator[Report | None]:
    """What the core reports its progress to: nothing, the given function, or a bar of tqdm.

    Raises:
        ImportError: `progress` is True and tqdm is not installed.
    """
    if not isinstance(progress, bool):
        yield progress
        return
    if not progress:
        yield None
        return
    from tqdm.auto import tqdm

    with tqdm(desc=title, total=0, leave=False) as bar:

        def report(done: int, total: int) -> None:
            bar.total = total
            bar.n = done
            bar.refresh()

        yield report

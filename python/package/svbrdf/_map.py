"""Maps of the rendering loss."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _reports
from ._report import pandas

if TYPE_CHECKING:
    import pandas as pd


class MapReport(_reports.MapReport):
    """The loss over texels."""

    maps: tuple[NDArray[Any], ...]
    """One per prediction: height x width x 3."""

    def __init__(self, views: "_core.Views", *, maps: tuple[NDArray[Any], ...]) -> None:
        super().__init__(views, maps=maps)

    def to_pandas(self) -> "pd.DataFrame":
        """The command line's CSV as a data frame of pandas: a row for each texel of each prediction.

        Raises:
            ImportError: pandas is not installed.
        """
        rows, columns = np.indices(self.maps[0].shape[:2])
        parts = [[columns, rows, *np.moveaxis(values, -1, 0)] for values in self.maps]
        names = np.repeat([result.prediction for result in self.results], rows.size)
        cells = (np.concatenate([np.ravel(part[i]) for part in parts]) for i in range(5))
        titles = ["column", "row", "red", "green", "blue"]
        return pandas().DataFrame({"prediction": names.astype(object), **dict(zip(titles, cells, strict=True))})

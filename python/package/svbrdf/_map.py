"""Maps of the rendering loss."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _reports
from ._report import pandas

if TYPE_CHECKING:
    import pandas as pd


class MapReport(_reports.MapReport):
    """The loss over texels, or over the directions of the light or the view."""

    maps: tuple[NDArray[Any], ...]
    """One per prediction. Over texels: height x width x 3. Over directions: side x side, NaN outside of the disk."""
    standard_errors: tuple[NDArray[Any], ...] | None
    """Over directions: side x side for each prediction, due to the choice of texels."""
    directions: NDArray[Any] | None
    """Over directions: side x side x 3, NaN outside of the disk."""

    def __init__(
        self,
        views: "_core.Views",
        *,
        maps: tuple[NDArray[Any], ...],
        standard_errors: tuple[NDArray[Any], ...] | None = None,
        directions: tuple[NDArray[Any]] | None = None,
    ) -> None:
        of_directions = None if directions is None else directions[0]
        super().__init__(views, maps=maps, standard_errors=standard_errors, directions=of_directions)

    def to_pandas(self) -> "pd.DataFrame":
        """The command line's CSV as a data frame of pandas: a row for each texel or direction of each prediction.

        Raises:
            ImportError: pandas is not installed.
        """
        if self.directions is None or self.standard_errors is None:
            columns = ["column", "row", "red", "green", "blue"]
            rows, places = np.indices(self.maps[0].shape[:2])
            parts = [[places, rows, *np.moveaxis(values, -1, 0)] for values in self.maps]
        else:
            columns = ["x", "y", "z", "loss", "standard_error"]
            inside = ~np.isnan(self.directions[..., 0])
            pairs = zip(self.maps, self.standard_errors, strict=True)
            parts = [[*self.directions[inside].T, values[inside], errors[inside]] for values, errors in pairs]
        names = np.repeat([result.prediction for result in self.results], np.size(parts[0][0]))
        cells = (np.concatenate([np.ravel(part[i]) for part in parts]) for i in range(len(columns)))
        return pandas().DataFrame({"prediction": names.astype(object), **dict(zip(columns, cells, strict=True))})

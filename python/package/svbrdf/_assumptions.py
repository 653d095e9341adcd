"""Assumptions about files and arrays."""

import warnings
from collections.abc import Sequence
from typing import NamedTuple


class AssumptionWarning(UserWarning):
    """Something about a file or an array was assumed, and another reading is as plausible."""


class Assumption(NamedTuple):
    """One thing that reading a material assumed."""

    what: str
    """What it is about, such as "albedo" or "normal y"."""
    chosen: str
    why: str
    certainty: str
    """"given", "sure", "likely" or "unsure"."""


def warn_unsure(name: str, assumptions: Sequence[Assumption], stacklevel: int) -> None:
    """Warns of what is unsure about the material `name`; `stacklevel` counts from the caller."""
    for unsure in (a for a in assumptions if a.certainty == "unsure"):
        text = f"{name}: {unsure.what}: {unsure.chosen}: {unsure.why}"
        warnings.warn(text, AssumptionWarning, stacklevel=stacklevel)

"""Doctests of docstrings as blocks of code."""

import re
from typing import Any

import griffe


class Doctests(griffe.Extension):
    """Fences doctests, which markdown would take for quotations."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Fences those of an object: from the first prompt to an empty line."""
        if obj.docstring:
            obj.docstring.value = re.sub(r"(?m)^>>> .*(?:\n.+)*", r"```pycon\n\g<0>\n```", obj.docstring.value)

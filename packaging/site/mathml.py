"""Blocks of mathematics of the pages as MathML, which browsers show without a script."""

from typing import Any

from latex2mathml.converter import convert


def block(source: str, *_: Any, **__: Any) -> str:
    """The MathML of a fenced block of LaTeX."""
    return f'<div style="margin: 1em 0; overflow-x: auto">{convert(source, display="block")}</div>'

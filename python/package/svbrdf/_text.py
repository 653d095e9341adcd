"""Text in the HTML of notebooks."""

import html


def escaped(text: str) -> str:
    """The text with markup escaped, and characters that steer its direction written as escapes."""
    steady = (c if c.isprintable() or c in "\n\u00a0" else c.encode("unicode_escape").decode() for c in text)
    return html.escape("".join(steady))

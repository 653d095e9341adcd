"""Tables of reports as HTML for notebooks."""

import html
from collections.abc import Sequence
from typing import Any

MOST_ROWS = 60
"""More rows are counted, not shown."""


def html_table(heading: str, columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """A table below its heading. Texts are data: nothing in them is read as markup."""
    titles = "".join(f'<th scope="col">{escaped(column)}</th>' for column in columns)
    shown = "".join(f"<tr>{''.join(f'<td>{cell(value)}</td>' for value in row)}</tr>" for row in rows[:MOST_ROWS])
    hidden = len(rows) - MOST_ROWS
    more = f"<p>{hidden:,} more rows: to_pandas() has all.</p>" if hidden > 0 else ""
    lines = "<br>".join(escaped(line) for line in heading.splitlines())
    return f"<div><p>{lines}</p><table><thead><tr>{titles}</tr></thead><tbody>{shown}</tbody></table>{more}</div>"


def cell(value: Any) -> str:
    """A value as text; floats in 6 digits, None as nothing."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.6g}" if isinstance(value, float) else escaped(str(value))


def escaped(text: str) -> str:
    """The text with markup escaped, and characters that steer its direction written as escapes."""
    steady = (c if c.isprintable() or c in "\n\u00a0" else c.encode("unicode_escape").decode() for c in text)
    return html.escape("".join(steady))

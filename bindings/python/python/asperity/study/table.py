"""Comma-separated values, read as strictly as RFC 4180 states them."""

from __future__ import annotations

import re
from typing import List

_CELL = re.compile(r'"((?:[^"]|"")*)"|([^",\r\n]*)')
_END = re.compile(r"\r?\n|\Z")


class TableError(ValueError):
    """Text that is no table; says in which row, of which the header is the first, and why."""


def rows(text: str) -> List[List[str]]:
    """The cells of each row, the header's first, however many a row has.

    A blank line is a row of one empty cell. Raises `TableError` for a quote that is not closed, or
    one inside a cell that does not start with one.
    """
    found: List[List[str]] = []
    row: List[str] = []
    at = 0
    while at < len(text) or row:
        cell = _CELL.match(text, at)
        assert cell is not None  # the second alternative also matches nothing
        at = cell.end()
        row.append(cell[2] if cell[1] is None else cell[1].replace('""', '"'))
        if text.startswith(",", at):
            at += 1
            continue
        end = _END.match(text, at)
        if end is None:
            cause = f"a stray {text[at]!r} in or after cell {len(row)}, or a quote without its end"
            raise TableError(f"row {len(found) + 1}: {cause}")
        at = end.end()
        found.append(row)
        row = []
    return found

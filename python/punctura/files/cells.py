"""Cells of CSV tables with words that a person chose, such as names."""

import csv
import io
import re
from collections.abc import Iterable

# A spreadsheet takes a cell for a formula after these; programs for East Asian writing know the wide forms, too.
_SIGNS = "=+@\uff1d\uff0b\uff0d\uff20-"
# Before the sign: what some programs leave out.
_SKIPPED = '\\s"\x00-\x1f\x7f-\xa0\u00ad\u200b-\u200f\u2028-\u202f\u2060-\u2064\ufeff'
# Where a cell begins: at the start, and where a program splits that expects other separators than a comma.
_FORMULA = re.compile(f"(^|[;\t\r\n])(?=[{_SKIPPED}]*[{_SIGNS}])|^(?=[\t\r\n])")


def text_cell(text: str) -> str:
    """The text with an apostrophe in front of each part that a spreadsheet could take for a formula."""
    return _FORMULA.sub(r"\1'", text)


def csv_line(cells: Iterable[object]) -> str:
    """One line; see text_cell for text that is not ours."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerow(cells)
    return out.getvalue()

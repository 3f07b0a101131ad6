"""Checks docs/equations.md (equation number -> file -> test) against the citations in the sources.

- Every `K06 (n)` cited in core has a row for that number.
- The file of every row exists and cites that number.
- The test of every row exists: `tests/python/x.py::test_name`, or `tests/core/x.cpp: name of the test case`.
"""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from sources import CPP_SUFFIXES, Finding, report, sources

TABLE = "docs/equations.md"
# "K06 (7)", "K06 (25), (26)", "K06 (18) and (19)", "K06 (21)-(23)", "K06 (16) to (19)", "K06 (38)(40)"
CITATION = re.compile(r"K06\s+((?:\(\d+\)(?:\s*(?:,|and|or|to|-|/)?\s*(?=\(\d))?)+)")
NUMBER = re.compile(r"(-|to)?\s*\((\d+)\)")


class Row(NamedTuple):
    line: int
    number: int
    file: str
    test: str


def cited(text: str) -> Iterator[tuple[int, int]]:
    """(line, number) of every equation that a text cites. A range cites both ends and all numbers between."""
    joined = re.sub(r"\n\s*(//+|#)", "\n", text)  # a citation may continue on the next comment line
    for match in CITATION.finditer(joined):
        line = joined.count("\n", 0, match.start()) + 1
        last = 0
        for separator, digits in NUMBER.findall(match[1]):
            number = int(digits)
            yield from ((line, n) for n in range(last + 1 if separator else number, number + 1))
            last = number


def rows(text: str) -> Iterator[Row | Finding]:
    """The rows of the table `| number | file | test |`. <br> separates several files or tests in a cell."""
    in_table = False
    for line, content in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in content.strip().strip("|").split("|")]
        if not content.lstrip().startswith("|"):
            in_table = False
        elif [cell.lower() for cell in cells[:3]] == ["number", "file", "test"]:
            in_table = True
        elif in_table and not set(content) <= set("|-: "):
            numbers = re.findall(r"\((\d+)\)", cells[0])
            if not numbers or len(cells) < 3 or not cells[1] or not cells[2]:
                yield Finding(TABLE, line, "a row needs a number in brackets, a file and a test")
                continue
            for number in numbers:
                for file in cells[1].split("<br>"):
                    for test in cells[2].split("<br>"):
                        yield Row(line, int(number), file.strip(" `"), test.strip(" `"))


def tests_in(path: Path) -> set[str]:
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        functions = (node.name for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef))
        return {name for name in functions if name.startswith("test")}
    return set(re.findall(r'TEST_CASE(?:_TEMPLATE|_FIXTURE)?\s*\((?:\s*\w+\s*,)?\s*"((?:[^"\\]|\\.)*)"', text))


def test_problem(root: Path, test: str) -> str | None:
    file, _, name = test.partition("::") if "::" in test else test.partition(": ")
    if not (root / file).is_file():
        return f"there is no file {file}"
    if name not in tests_in(root / file):
        return f"there is no test {name!r} in {file}"
    return None


def findings(root: Path) -> list[Finding]:
    table = root / TABLE
    if not table.is_file():
        return [Finding(TABLE, 1, "is missing")]
    read = list(rows(table.read_text(encoding="utf-8")))
    found = [row for row in read if isinstance(row, Finding)]
    table_rows = [row for row in read if isinstance(row, Row)]
    if not table_rows:
        found.append(Finding(TABLE, 1, "has no table with the columns number | file | test"))

    numbers = {row.number for row in table_rows}
    for path in sources(root, CPP_SUFFIXES):
        if path.startswith("core/"):
            for line, number in cited((root / path).read_text(encoding="utf-8")):
                if number not in numbers:
                    found.append(Finding(path, line, f"cites K06 ({number}), and {TABLE} has no row ({number})"))
    for line, number, file in sorted({(row.line, row.number, row.file) for row in table_rows}):
        if not (root / file).is_file():
            found.append(Finding(TABLE, line, f"({number}): there is no file {file}"))
        elif number not in {n for _, n in cited((root / file).read_text(encoding="utf-8"))}:
            found.append(Finding(TABLE, line, f"({number}): {file} does not cite K06 ({number})"))
    for line, test in sorted({(row.line, row.test) for row in table_rows}):
        if problem := test_problem(root, test):
            found.append(Finding(TABLE, line, problem))
    return found


if __name__ == "__main__":
    sys.exit(report("equations", findings, sys.argv))

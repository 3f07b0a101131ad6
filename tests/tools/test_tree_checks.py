"""Each check of the tree passes on a good tree and says what is wrong, and where, on a bad one."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest

TOOLS = Path(__file__).resolve().parents[2] / "tools"


@pytest.fixture
def check(monkeypatch):
    monkeypatch.syspath_prepend(str(TOOLS))

    def load(name: str) -> ModuleType:
        sys.modules.pop("sources", None)
        return importlib.import_module(f"check_{name}")

    return load


def plant(root: Path, **files: str) -> Path:
    """A small tree; in the names `__` stands for a slash and `_dot_` for a dot."""
    for name, text in files.items():
        path = root / name.replace("__", "/").replace("_dot_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return root


def said(module: ModuleType, root: Path) -> list[str]:
    return [str(finding) for finding in module.findings(root)]


@pytest.mark.parametrize("name", ["rooms", "sizes", "equations"])
def test_a_finding_is_printed_and_fails_the_command(check, name, tmp_path, capsys):
    module = check(name)
    root = plant(tmp_path, core__punctura__model__a_dot_hpp='#include "punctura/servo/b.hpp"  // K06 (99)\n' * 400)
    assert module.report(name, module.findings, ["check", str(root)]) == 1
    assert capsys.readouterr().out.endswith(" findings\n")


def test_an_include_of_a_lower_room_is_found(check, tmp_path):
    root = plant(
        tmp_path,
        core__punctura__model__a_dot_hpp='#pragma once\n#include "punctura/proxy/b.hpp"\n',
        core__punctura__proxy__b_dot_hpp='#include <punctura/model/c.hpp>\n#include "b2.hpp"\n#include <vector>\n',
        core__punctura__proxy__b2_dot_hpp='#include "../servo/d.hpp"\n',
        core__punctura__model__c_dot_hpp="",
        core__punctura__servo__d_dot_hpp="",
    )
    assert said(check("rooms"), root) == [
        "core/punctura/model/a.hpp:2: core/punctura/model may not include core/punctura/proxy/b.hpp: it lies below",
        "core/punctura/proxy/b2.hpp:1: core/punctura/proxy may not include core/punctura/servo/d.hpp: it lies below",
    ]


def test_an_unknown_room_and_a_header_that_is_not_there_are_found(check, tmp_path):
    root = plant(
        tmp_path,
        core__punctura__attic__a_dot_hpp="",
        core__punctura__model__b_dot_hpp='#include "punctura/model/gone.hpp"\n',
    )
    assert said(check("rooms"), root) == [
        "core/punctura/attic/a.hpp:1: lies in no room that tools/check_rooms.py knows",
        "core/punctura/model/b.hpp:1: includes punctura/model/gone.hpp, which does not exist",
    ]


def test_the_package_may_not_import_tests_nor_its_own_command_line(check, tmp_path):
    root = plant(
        tmp_path,
        python__punctura__a_dot_py="import numpy\nfrom oracles import law\nfrom .cli import main\n",
        python__punctura__cli__b_dot_py="from punctura.cli import c\nfrom . import d\n",
    )
    assert said(check("rooms"), root) == [
        "python/punctura/a.py:2: the package may not import oracles",
        "python/punctura/a.py:3: only the command line and the studio may import punctura.cli",
    ]


def test_a_file_of_351_lines_is_found_and_one_of_350_is_not(check, tmp_path):
    root = plant(tmp_path, a_dot_py="x = 1\n" * 350, b_dot_cpp="\n", c_dot_hpp="\n", d_dot_sh="\n")
    assert said(check("sizes"), root) == []
    plant(tmp_path, a_dot_py="x = 1\n" * 351)
    assert said(check("sizes"), root) == ["a.py:351: 351 lines; none may have over 350"]


def test_too_many_files_over_200_lines_are_found(check, tmp_path):
    root = plant(tmp_path, a_dot_py="\n" * 201, b_dot_py="\n" * 220, c_dot_py="\n")
    assert said(check("sizes"), root) == ["b.py:220: one of 2 files over 200 lines, of 3: most must be shorter"]


GOOD = {
    "core__punctura__model__a_dot_hpp": "// K06 (1), (2) and (4)-(6)\nint a;  // see K06\n// (8)\n",
    "tests__core__a_dot_cpp": 'TEST_CASE("it: adds") {}\nTEST_CASE_TEMPLATE("it \\"halves\\"", T, int) {}\n',
    "tests__python__test_a_dot_py": "def test_b():\n    pass\n",
}
TABLE = """
| number | file | test |
|---|---|---|
| (1) (2) | core/punctura/model/a.hpp | tests/core/a.cpp: it: adds |
| (4) (5) (6) | `core/punctura/model/a.hpp` | `tests/core/a.cpp: it: adds`<br>`tests/python/test_a.py::test_b` |
| (8) | core/punctura/model/a.hpp | tests/python/test_a.py::test_b |
"""


def test_a_table_that_fits_the_sources_is_in_order(check, tmp_path):
    assert said(check("equations"), plant(tmp_path, **GOOD, docs__equations_dot_md=TABLE)) == []


@pytest.mark.parametrize(
    ("old", "new", "finding"),
    [
        ("| (8) |", "| (9) |", "core/punctura/model/a.hpp:2: cites K06 (8), and docs/equations.md has no row (8)"),
        ("| (8) |", "| (9) |", "docs/equations.md:6: (9): core/punctura/model/a.hpp does not cite K06 (9)"),
        ("(4) (5) (6)", "(4) (6)", "core/punctura/model/a.hpp:1: cites K06 (5), and docs/equations.md has no row (5)"),
        ("(8) | core/punctura/model/a", "(8) | core/b", "docs/equations.md:6: (8): there is no file core/b.hpp"),
        (
            "::test_b` |",
            "::test_c` |",
            "docs/equations.md:5: there is no test 'test_c' in tests/python/test_a.py",
        ),
        ("it: adds |", "it: subtracts |", "docs/equations.md:4: there is no test 'it: subtracts' in tests/core/a.cpp"),
        ("core/a.cpp: it", "core/z.cpp: it", "docs/equations.md:4: there is no file tests/core/z.cpp"),
        ("| (8) |", "| eight |", "docs/equations.md:6: a row needs a number in brackets, a file and a test"),
        ("| number |", "| equation |", "docs/equations.md:1: has no table with the columns number | file | test"),
    ],
)
def test_whatever_does_not_fit_the_table_is_found(check, tmp_path, old, new, finding):
    assert old in TABLE
    root = plant(tmp_path, **GOOD, docs__equations_dot_md=TABLE.replace(old, new))
    assert finding in said(check("equations"), root)


def test_a_missing_table_is_found(check, tmp_path):
    assert said(check("equations"), plant(tmp_path, **GOOD)) == ["docs/equations.md:1: is missing"]

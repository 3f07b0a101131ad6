"""Each check of the source tree passes on a good tree, and reports problem and place on a bad one."""

import importlib
import platform
import subprocess
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import pytest

TOOLS = Path(__file__).resolve().parents[2] / "tools"


@pytest.fixture
def check():
    return lambda name: importlib.import_module(f"check_{name}")


def plant(root: Path, **files: str) -> Path:
    """Creates a small tree. In the names `__` stands for a slash and `_dot_` for a dot."""
    for name, text in files.items():
        path = root / name.replace("__", "/").replace("_dot_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return root


def found_by(module: ModuleType, root: Path) -> list[str]:
    return [str(finding) for finding in module.findings(root)]


@pytest.mark.parametrize("name", ["rooms", "sizes", "equations", "locale", "includes"])
def test_a_finding_is_printed_and_fails_the_command(check, name, tmp_path, capsys):
    module = check(name)
    root = plant(
        tmp_path,
        core__punctura__model__a_dot_hpp='#include "punctura/servo/b.hpp"; std::map atof("1")  // K06 (99)\n' * 400,
    )
    assert module.report(name, module.findings, ["check", str(root)]) == 1
    assert capsys.readouterr().out.endswith(" findings\n")


def test_a_number_that_follows_the_locale_is_found(check, tmp_path):
    text = 'snprintf(text, 9, "%d %.4g", 1, x);\nprintf("%5.1f");  // %g\nsnprintf(text, 9, "%d %%");\nstrtod(a, b);\n'
    root = plant(tmp_path, capi__a_dot_cpp=text, examples__b_dot_cpp=text)
    places = [(1, "%.4g"), (2, "%5.1f"), (4, "strtod")]
    assert found_by(check("locale"), root) == [
        f"capi/a.cpp:{n}: {what} follows the locale: use decimal.hpp" for n, what in places
    ]


def test_a_standard_header_that_is_missing_is_found_and_one_that_our_headers_include_is_not(check, tmp_path):
    root = plant(
        tmp_path,
        core__punctura__a_dot_hpp="#include <vector>\n#include <array>\n",
        core__punctura__b_dot_hpp='#include "punctura/a.hpp"\nstd::vector<std::string> x;  // std::map\nstd::byte y;\n'
        'f("a \\" std::map");\n',
        core__punctura__c_dot_cpp="std::map<int, int> x;\n",
    )
    assert found_by(check("includes"), root) == ["core/punctura/b.hpp:2: include <string>"]


def test_every_header_that_is_precompiled_is_one_whose_names_are_known(check):
    text = (TOOLS.parent / "cmake" / "precompiled.cmake").read_text(encoding="utf-8")
    listed = text.split("PRIVATE\n")[1].split(" ${ARGN}")[0]
    assert {name.strip("<>") for name in listed.split()} == set(check("includes").FOR)


def test_an_include_of_a_lower_room_is_found(check, tmp_path):
    root = plant(
        tmp_path,
        core__punctura__model__a_dot_hpp='#pragma once\n#include "punctura/proxy/b.hpp"\n',
        core__punctura__proxy__b_dot_hpp='#include <punctura/model/c.hpp>\n#include "b2.hpp"\n#include <vector>\n',
        core__punctura__proxy__b2_dot_hpp='#include "../servo/d.hpp"\n',
        core__punctura__model__c_dot_hpp="",
        core__punctura__servo__d_dot_hpp="",
    )
    assert found_by(check("rooms"), root) == [
        "core/punctura/model/a.hpp:2: core/punctura/model may not include core/punctura/proxy/b.hpp, "
        "which is in a lower room",
        "core/punctura/proxy/b2.hpp:1: core/punctura/proxy may not include core/punctura/servo/d.hpp, "
        "which is in a lower room",
    ]


def test_an_unknown_room_and_a_header_that_is_not_there_are_found(check, tmp_path):
    root = plant(
        tmp_path,
        core__punctura__attic__a_dot_hpp="",
        core__punctura__model__b_dot_hpp='#include "punctura/model/gone.hpp"\n',
    )
    assert found_by(check("rooms"), root) == [
        "core/punctura/attic/a.hpp:1: is in no room that tools/check_rooms.py knows",
        "core/punctura/model/b.hpp:1: includes punctura/model/gone.hpp, which does not exist",
    ]


def test_the_package_may_not_import_tests(check, tmp_path):
    root = plant(tmp_path, python__punctura__scene__a_dot_py="import numpy\nfrom oracles import law\n")
    assert found_by(check("rooms"), root) == ["python/punctura/scene/a.py:2: the package may not import oracles"]


PYTHON_ROOMS = ("files", "scene", "simulation", "record", "events", "live", "exercise", "reproduce", "studio", "cli")
PAGE_ROOMS = ("wire", "engine", "state", "hand", "plots", "scene", "controls")
IMPORTS = [  # folder, ending, and an import of b from another room
    *(("python/punctura", "py", "from punctura.{} import b\n", *rooms) for rooms in pairwise(PYTHON_ROOMS)),
    *(("web/src", "ts", 'import "../{}/b.ts";\n', *rooms) for rooms in pairwise(PAGE_ROOMS)),
]


@pytest.mark.parametrize(("folder", "end", "text", "higher", "lower"), IMPORTS)
def test_an_import_of_a_lower_room_is_found_and_one_of_a_higher_room_is_not(
    check, tmp_path, folder, end, text, higher, lower
):
    def found(room: str, other: str) -> list[str]:
        files = {f"{folder}/{other}/b.{end}": "", f"{folder}/{room}/a.{end}": text.format(other)}
        return found_by(check("rooms"), plant(tmp_path / room, **files))

    assert found(lower, higher) == []
    assert found(higher, lower) == [
        f"{folder}/{higher}/a.{end}:1: {folder}/{higher} may not import {folder}/{lower}/b.{end}, "
        "which is in a lower room"
    ]


@pytest.mark.parametrize(
    "text",
    [
        "import punctura.cli\n",
        "from ..cli import main\n",
        "def f():\n    from punctura.cli import main\n",
        "if TYPE_CHECKING:\n    from punctura.cli import main\n",
        "from punctura import cli\n",
        "from punctura import main\n",  # punctura/__init__.py has it from the command line
    ],
)
def test_every_form_of_a_python_import_is_read(check, tmp_path, text):
    root = plant(tmp_path, python__punctura__scene__a_dot_py=text, python__punctura__cli__b_dot_py="")
    (root / "python/punctura/cli/__init__.py").write_text("")
    (root / "python/punctura/__init__.py").write_text("from punctura.cli import main\n")
    found = found_by(check("rooms"), root)
    line = text.count("\n")
    where = f"python/punctura/scene/a.py:{line}: python/punctura/scene may not import"
    assert [one for one in found if one.startswith(where)] == [
        f"{where} python/punctura/cli/__init__.py, which is in a lower room"
    ]


def test_an_import_from_punctura_counts_for_the_module_that_has_the_name(check, tmp_path):
    root = plant(tmp_path, python__punctura__scene__a_dot_py="from punctura import Scene, _core\n")
    (root / "python/punctura/__init__.py").write_text("from punctura._core import Scene\n__version__ = '1'\n")
    assert found_by(check("rooms"), root) == []
    plant(tmp_path, python__punctura__scene__a_dot_py="from punctura import __version__\n")
    assert found_by(check("rooms"), root) == [
        "python/punctura/scene/a.py:1: python/punctura/scene may not import python/punctura/__init__.py, "
        "which is in a lower room"
    ]


@pytest.mark.parametrize(
    "text",
    [
        'import "../controls/b.ts";',
        'import {\n  b,\n} from "../controls/b.ts";',
        'import type { B } from "../controls/b.ts";',
        'export * from "../controls/b.ts";',
        'const b = await import("../controls/b.ts");',
        'new Worker(new URL("../controls/b.ts", import.meta.url));',
    ],
)
def test_every_form_of_a_page_import_is_read(check, tmp_path, text):
    root = plant(tmp_path, web__src__scene__a_dot_ts=text, web__src__controls__b_dot_ts="")
    line = text.count("\n") + 1
    assert found_by(check("rooms"), root) == [
        f"web/src/scene/a.ts:{line}: web/src/scene may not import web/src/controls/b.ts, which is in a lower room"
    ]


def test_files_that_import_each_other_are_found(check, tmp_path):
    root = plant(
        tmp_path,
        python__punctura__studio__a_dot_py="from punctura.studio import b\n",
        python__punctura__studio__b_dot_py="from punctura.studio.c import x\n",
        python__punctura__studio__c_dot_py="\ndef f():\n    from punctura.studio.a import y\n",
        python__punctura__studio__d_dot_py="from punctura.studio import a\n",
        web__src__plots__a_dot_ts='import { b } from "./b.ts";',
        web__src__plots__b_dot_ts='import type { A } from "./a.ts";',
    )
    files = ", ".join(f"python/punctura/studio/{name}.py" for name in "abc")
    assert found_by(check("rooms"), root) == [
        f"python/punctura/studio/a.py:1: import circle: {files}",
        "web/src/plots/a.ts:1: import circle: web/src/plots/a.ts, web/src/plots/b.ts",
    ]


def test_python_and_page_files_outside_all_rooms_and_page_files_that_are_not_there_are_found(check, tmp_path):
    root = plant(
        tmp_path,
        python__punctura__attic__a_dot_py="import numpy\n",
        web__src__attic__a_dot_ts='import "./gone.ts";\nimport "./style.css";\n',
        web__src__state__a_dot_ts='import "./gone.ts";\nimport "./style.css";\n',
    )
    reason = "is in no room that tools/check_rooms.py knows"
    assert found_by(check("rooms"), root) == [
        f"python/punctura/attic/a.py:1: {reason}",
        f"web/src/attic/a.ts:1: {reason}",
        "web/src/state/a.ts:1: imports ./gone.ts, which does not exist",
    ]


def test_a_file_of_351_lines_is_found_and_one_of_350_is_not(check, tmp_path):
    root = plant(tmp_path, a_dot_py="x = 1\n" * 350, b_dot_cpp="\n", c_dot_hpp="\n", d_dot_sh="\n")
    assert found_by(check("sizes"), root) == []
    plant(tmp_path, a_dot_py="x = 1\n" * 351)
    assert found_by(check("sizes"), root) == ["a.py:351: 351 lines; the limit is 350"]


def test_too_many_files_over_200_lines_are_found(check, tmp_path):
    root = plant(tmp_path, a_dot_py="\n" * 201, b_dot_py="\n" * 220, c_dot_py="\n")
    assert found_by(check("sizes"), root) == ["b.py:220: one of 2 files over 200 lines; the limit is a quarter of 3"]


@pytest.mark.parametrize("name", ["a.py", "a.ts", "a.hpp", "a.sh", "a.cmake"])
def test_a_line_of_121_columns_is_found_and_one_of_120_is_not(check, tmp_path, name):
    (tmp_path / name).write_text("x\n" + "é" * 120 + "\n", encoding="utf-8")
    assert found_by(check("sizes"), tmp_path) == []
    (tmp_path / name).write_text("x\n" + "é" * 121 + "\n", encoding="utf-8")
    assert found_by(check("sizes"), tmp_path) == [f"{name}:2: 121 columns; the limit is 120"]


def test_a_web_address_a_generated_file_and_a_document_may_have_longer_lines(check, tmp_path):
    long = "x" * 130 + "\n"
    root = plant(
        tmp_path,
        a_dot_py=f"# https://example.org/{long}",
        web__src__wire__tick_table_dot_ts=long,
        docs__a_dot_md=long,
    )
    assert found_by(check("sizes"), root) == []


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
    assert found_by(check("equations"), plant(tmp_path, **GOOD, docs__equations_dot_md=TABLE)) == []


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
    assert finding in found_by(check("equations"), root)


def test_a_missing_table_is_found(check, tmp_path):
    assert found_by(check("equations"), plant(tmp_path, **GOOD)) == ["docs/equations.md:1: is missing"]


@pytest.mark.skipif(platform.machine() != "x86_64", reason="AVX is an instruction set of x86-64")
def test_code_that_an_object_of_avx2_shares_is_a_finding_only_if_it_has_an_instruction_of_avx2(tmp_path):
    object_file = tmp_path / "runtime/CMakeFiles/punctura_batch.dir/punctura_runtime/batch/line_avx2.cpp.o"
    object_file.parent.mkdir(parents=True)
    code = """template <class T> [[gnu::noinline]] T sum(const T* v) { return v[0] + v[1]; }
    double sum_avx2(const double* v) { return sum(v); }"""
    for options, status in ([], 0), (["-mavx2"], 1):
        compiler = ["c++", "-O2", *options, "-xc++", "-", "-c", "-o", object_file]
        subprocess.run(compiler, input=code, text=True, check=True)
        done = subprocess.run([TOOLS / "check_isa.sh", tmp_path], capture_output=True, text=True)
        assert (done.returncode, "double sum<double>" in done.stdout) == (status, bool(status))

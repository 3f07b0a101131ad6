"""Checks that a header of core or runtime includes the standard headers of the names that it uses.

Directly, or by our headers that it includes. A compiler finds only some of them, because a standard header may include
another one; and with a precompiled header it finds none.
"""

import re
import sys
from functools import cache
from pathlib import Path

from imports import cpp_imports
from sources import Finding, report

# The headers of cmake/precompiled.cmake, and what they are for. Those not here have the name of what they are for.
FOR = {
    "algorithm": "all_of any_of clamp copy copy_n count_if equal fill fill_n find find_if generate is_sorted max "
    "lower_bound max_element min min_element none_of nth_element remove_if reverse rotate sort stable_sort transform "
    "unique",
    "atomic": "atomic atomic_ref memory_order_acquire memory_order_relaxed memory_order_release",
    "cmath": "abs acos asin atan atan2 cbrt ceil copysign cos cosh erf exp expm1 fabs floor fma fmod frexp hypot isinf "
    "isfinite isnan ldexp log log1p lround nextafter pow remainder round signbit sin sinh sqrt tan tanh trunc",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t uintptr_t",
    "functional": "bind function hash less plus",
    "limits": "numeric_limits",
    "memory": "addressof make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "call_once lock_guard mutex once_flag scoped_lock unique_lock",
    "optional": "nullopt optional",
    "string": "string to_string",
    "system_error": "error_code system_error",
    "thread": "jthread this_thread thread",
    "utility": "declval exchange forward in_place index_sequence integer_sequence make_index_sequence make_pair move "
    "pair swap",
    **{name: name for name in ("array", "chrono", "condition_variable", "filesystem", "map", "span", "vector")},
}
HEADER = {name: header for header, names in FOR.items() for name in names.split()}
NAME = re.compile(r"\bstd::(\w+)")
QUOTED = re.compile(r"""'(?:[^'\\]|\\.)'|"(?:[^"\\]|\\.)*\"""")


def findings(root: Path) -> list[Finding]:
    ours: dict[str, set[str]] = {}
    standard: dict[str, set[str]] = {}
    for path, _, name, target in cpp_imports(root):
        (standard if target is None else ours).setdefault(path, set()).add(target or name)

    @cache
    def given(path: str) -> frozenset[str]:
        return frozenset(standard.get(path, ())).union(*(given(one) for one in ours.get(path, ())))

    found = []
    for file in sorted([*(root / "core").rglob("*.hpp"), *(root / "runtime").rglob("*.hpp")]):
        path, lines = file.relative_to(root).as_posix(), file.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines, 1):
            needed = {HEADER[name] for name in NAME.findall(QUOTED.sub("", line).split("//")[0]) if name in HEADER}
            found += [Finding(path, number, f"include <{header}>") for header in sorted(needed - given(path))]
    return found


if __name__ == "__main__":
    sys.exit(report("includes", findings, sys.argv))

"""Generates capi/src/scene_keys.hpp, the keys of a scene file for the C ABI, from the schema of the Python package.

python tools/make_scene_keys.py          writes the file
python tools/make_scene_keys.py --check  fails if the file is out of date
"""

from __future__ import annotations

import argparse
import json
import sys
import typing
from collections.abc import Iterable, Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

from punctura.files.fields import Number, NumberOrAutomatic, Numbers, Vector, WholeNumber
from punctura.files.units import split_key
from punctura.scene.gauges import GAUGE_DIAMETER_MM
from punctura.scene.schema import ROWS, SceneFile
from pydantic import BaseModel, PlainValidator

PATH = Path(__file__).resolve().parents[1] / "capi/src/scene_keys.hpp"

TEXT = """// Made by tools/make_scene_keys.py, from the schema of scene files in python/punctura/scene.
#pragma once

// clang-format off
#include <string_view>

namespace punctura::c {{

/// What a key holds.
enum class KeyKind {{ number, number_or_word, vector, column, word, gauge }};

/// A key of a scene file. A value in SI units is the number in the file times `digits` times 10^exponent.
struct SceneKey {{
  std::string_view table, key;
  std::string_view name;  ///< in the core; a column has [] in place of the row: "profile[].depth"
  KeyKind kind;
  bool has_default;
  std::string_view digits;
  int exponent;
}};

inline constexpr SceneKey scene_keys[] = {{
{keys}
}};

/// A needle's gauge and its outer diameter, m. ISO 9626
struct GaugeDiameter {{
  long long gauge;
  std::string_view digits;
  int exponent;
}};

inline constexpr GaugeDiameter gauge_diameters[] = {{
{gauges}
}};

}}  // namespace punctura::c
"""


def validators(annotation: Any, metadata: Iterable[Any]) -> set[Any]:
    """The validating functions of a field's type, also inside a union."""
    found = {part.func for part in metadata if isinstance(part, PlainValidator)}
    for part in typing.get_args(annotation):
        found |= validators(part, getattr(part, "__metadata__", ()))
    return found


KINDS = {
    next(iter(validators(None, typing.get_args(typing.Annotated[kind, ""])[1:]))): name
    for kind, name in (
        (Number, "number"),
        (NumberOrAutomatic, "number_or_word"),
        (Vector, "vector"),
        (Numbers, "column"),
        (WholeNumber, "gauge"),
    )
}


def kind_of(info: Any) -> str:
    kinds = [KINDS[f] for f in validators(info.annotation, info.metadata) if f in KINDS]
    return kinds[0] if kinds else "word"


def digits_of(number: Decimal) -> tuple[str, int]:
    """A positive decimal number as digits and a power of ten."""
    _, digits, exponent = number.as_tuple()
    text = "".join(map(str, digits)).lstrip("0")
    short = text.rstrip("0")
    return short, int(exponent) + len(text) - len(short)


def rows(table: str, model: Any) -> Iterator[str]:
    for key, info in model.model_fields.items():
        name, unit = split_key(key)
        kind = kind_of(info)
        if kind == "gauge":
            name = "diameter"
        if kind == "column":
            name = next(f"{rows}[].{of[key]}" for rows, of in ROWS[table].items() if key in of)
        digits, exponent = digits_of(unit.si)
        has_default = not info.is_required() and info.default is not None
        texts = ", ".join(json.dumps(text) for text in (table, key, name))
        row = f'    {{{texts}, KeyKind::{kind}, {str(has_default).lower()}, "{digits}", {exponent}}},'
        if len(row) > 120:
            head, tail = row.split(", KeyKind", 1)
            row = f"{head},\n     KeyKind{tail}"
        yield row


def text() -> str:
    keys = [row for row in rows("", SceneFile) if '"name"' in row]
    for table, info in SceneFile.model_fields.items():
        annotations = [info.annotation, *getattr(info.annotation, "__args__", ())]
        for model in annotations:
            if isinstance(model, type) and issubclass(model, BaseModel):
                keys += rows(table, model)
    gauges = []
    for gauge, diameter in GAUGE_DIAMETER_MM.items():
        digits, exponent = digits_of(Decimal(diameter).scaleb(-3))
        gauges.append(f'    {{{gauge}, "{digits}", {exponent}}},')
    return TEXT.format(keys="\n".join(keys), gauges="\n".join(gauges))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare only")
    if not parser.parse_args().check:
        PATH.write_text(text(), encoding="utf-8", newline="\n")
    elif not PATH.is_file() or PATH.read_text(encoding="utf-8") != text():
        print(f"{PATH.name} does not match the schema of scene files; run: python tools/make_scene_keys.py")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

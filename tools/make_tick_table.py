"""Writes what others read of core's table of a tick's fields (core/punctura/servo/tick_table.hpp).

python tools/make_tick_table.py          writes docs/tick.md and web/src/wire/tick_table.ts
python tools/make_tick_table.py --check  fails where they are not what would be written
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from punctura._core import TickField
from punctura.ticks import FIELDS

ROOT = Path(__file__).resolve().parents[1]

PAGE = """# The fields of a tick

One table in the core, `core/punctura/servo/tick_table.hpp`, names every field of a tick. `punctura.Ticks`,
recordings, exports, the studio's page and this page follow it. SI units throughout;
[conventions.md](conventions.md) has axes and signs.

```python
import numpy
import punctura

ticks = punctura.simulate("k06-fig12", numpy.linspace(-1e-3, 9e-3, 3200))
print(ticks.force[-1], ticks["depth"][:, 0].max(), ticks[100:200])  # arrays; a slice gives Ticks
table, frame = ticks.to_arrow(), ticks.to_pandas()  # with the columns of a file; to_polars() needs the package polars
ticks.save("run.parquet")  # or .csv
ticks.plot("depth").figure.savefig("run.png")  # each membrane's force along the needle, and its band
```

In Python a field is an attribute, `ticks.force`, an array with one row a tick: n ticks, m membranes. In a file it
is one column for each component and each membrane, in the order of this table; the columns of the first membrane
stand together, then those of the next. The membranes count from 0, in the order of the scene. A membrane that the
scene of a tick does not have is NaN in Python, and an empty cell (null) in a file.

| field | shape | columns of a file | unit | what it is |
|---|---|---|---|---|
{rows}

Fields with words hold their numbers in Python, `Phase(ticks.phase[0, 0]).name`, and the words in a file:

| field | words, from 0 |
|---|---|
{words}

## Which ticks have which fields

| ticks of | fields |
|---|---|
| `Proxy1d.run` | position, force, depth, axial_force, lower, upper, phase, proxy: each (n,), along the needle |
| `Proxy3d.run` | these and axis, direction; of the membrane (n,), vectors (n, 3) |
| `Insertion.run` | position, axis, tip, force, and all fields of the membranes |
| `simulate` in memory | those of `Insertion.run`, tick and time |
| `Experiment.run` | all |
| a loop's `Listener.read`, `latest`, `fault_history` | all but true_position and desired |
| `open_recording(...).ticks()` | the same, and `lost`: ticks that are missing before the row |
"""

MODULE = """// Made by tools/make_tick_table.py, from core's table of a tick's fields.

/** In the order of a file's columns. column: {{a}} is x, y or z, {{i}} the membrane's number. words: by number. */
export const FIELDS = [
{fields}
] as const;
"""


def shape(field: TickField) -> str:
    sizes = ["n", *["m"] * field.per_membrane, *["3"] * (field.width == 3)]
    return f"({', '.join(sizes)}{',' * (len(sizes) == 1)})"


def columns(field: TickField) -> str:
    return f"`{field.column.replace('{i}', 'i').replace('{a}', 'x')}`" + (" and y, z" if field.width > 1 else "")


def page() -> str:
    fields = FIELDS.values()
    rows = [f"| `{f.name}` | {shape(f)} | {columns(f)} | {f.unit} | {f.says} |" for f in fields]
    words = [f"| `{f.name}` | {', '.join(f.words)} |" for f in fields if f.words]
    return PAGE.format(rows="\n".join(rows), words="\n".join(words))


def module() -> str:
    def row(field: TickField) -> str:
        named = f'name: "{field.name}", column: "{field.column}", width: {field.width}'
        words = "null" if field.words is None else "[" + ", ".join(f'"{word}"' for word in field.words) + "]"
        return f"  {{ {named}, perMembrane: {str(field.per_membrane).lower()}, words: {words} }},"

    return MODULE.format(fields="\n".join(row(field) for field in FIELDS.values() if field.on_page))


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="fail where the files are not what would be written")
    check = parser.parse_args(argv).check
    old = []
    for path, text in (
        (ROOT / "docs" / "tick.md", page()),
        (ROOT / "web" / "src" / "wire" / "tick_table.ts", module()),
    ):
        if not check:
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            old.append(str(path.relative_to(ROOT)))
    if old:
        print(f"{', '.join(old)} do not match core's table; run: python tools/make_tick_table.py", file=sys.stderr)
    return 1 if old else 0


if __name__ == "__main__":
    sys.exit(main())

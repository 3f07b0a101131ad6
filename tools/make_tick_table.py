"""Generates files from the core's table of tick fields (core/punctura/servo/tick_table.hpp) and the limits' words.

python tools/make_tick_table.py          writes docs/tick.md, and tick_table.ts and limit_words.json in web/src/wire
python tools/make_tick_table.py --check  fails if these files are out of date
"""

import json
import sys

from generated import write
from punctura._core import TickField
from punctura.live.force_words import CUTS, LIMIT_WORDS
from punctura.ticks import FIELDS

PAGE = """# The fields of a tick

One table in the core, `core/punctura/servo/tick_table.hpp`, defines every field of a tick. `punctura.Ticks`,
recordings, exports, the studio's page and this page follow this table. All units are SI.
[conventions.md](conventions.md) describes axes and signs.

```python
import numpy
import punctura

ticks = punctura.simulate("k06-fig12", numpy.linspace(-1e-3, 9e-3, 3200))
print(ticks.force[-1], ticks["depth"][:, 0].max(), ticks[100:200])  # arrays; a slice gives Ticks
table, frame = ticks.to_arrow(), ticks.to_pandas()  # with the columns of a file; needs pandas; to_polars(): polars
ticks.save("ticks.parquet")  # or .csv
ticks.plot("depth").figure.savefig("run.png")  # each membrane's force along the needle, and its band
```

In Python a field is an attribute, for example `ticks.force`. It is an array with one row per tick: n ticks, m
membranes. In a file, a field has one column for each component and each membrane, in the order of this table. All
columns of the first membrane come first, then those of the next. The membranes are numbered from 0, in the order of
the scene. If the scene of a tick lacks a membrane, its values
are NaN in Python, its `phase` is 255, and a file has empty cells (null).

| field | shape | columns of a file | unit | what it is |
|---|---|---|---|---|
{rows}

Some fields have words. In Python they hold numbers: `Phase(ticks.phase[0, 0]).name` gives the word. A file holds the
words:

| field | words, from 0 |
|---|---|
{words}

## Which ticks have which fields

| ticks from | fields |
|---|---|
| `Proxy1d.run` | position, force, depth, axial_force, lower, upper, phase, proxy: each (n,), along the needle |
| `Proxy3d.run` | the same, and axis, direction; fields of the membrane are (n,), vectors (n, 3) |
| `Insertion.run` | position, axis, tip, force, and all fields of the membranes |
| `simulate` in memory | the same as `Insertion.run`, and tick, time |
| `Experiment.run` | all |
| a loop's `Listener.read`, `latest`, `fault_history` | all but true_position and desired |
| `open_recording(...).ticks()` | the same, and `ticks["lost"]`: the number of ticks that are missing before the row |
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
    rows = [f"| `{f.name}` | {shape(f)} | {columns(f)} | {f.unit} | {f.help} |" for f in fields]
    words = [f"| `{f.name}` | {', '.join(f.words)} |" for f in fields if f.words]
    return PAGE.format(rows="\n".join(rows), words="\n".join(words))


def module() -> str:
    def row(field: TickField) -> str:
        named = f'name: "{field.name}", column: "{field.column}", width: {field.width}'
        words = "null" if field.words is None else "[" + ", ".join(f'"{word}"' for word in field.words) + "]"
        return f"  {{ {named}, perMembrane: {str(field.per_membrane).lower()}, words: {words} }},"

    return MODULE.format(fields="\n".join(row(field) for field in FIELDS.values() if field.on_page))


def main(argv: list[str] | None = None) -> int:
    files = {
        "docs/tick.md": page(),
        "web/src/wire/tick_table.ts": module(),
        "web/src/wire/limit_words.json": json.dumps({"words": LIMIT_WORDS, "cuts": CUTS}, indent=2) + "\n",
    }
    return write(__file__, __doc__, files, argv)


if __name__ == "__main__":
    sys.exit(main())

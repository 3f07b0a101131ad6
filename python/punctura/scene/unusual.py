"""Numbers of a scene file that are probably in another unit: possible, but off by a factor of 1,000."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from decimal import Decimal

from punctura import _core
from punctura.files.tables import Location, location_of
from punctura.files.toml_lines import key_lines
from punctura.files.units import split_key
from punctura.scene.build import Parts
from punctura.scene.schema import SceneFile


class UnusualWarning(UserWarning):
    """A number of a scene file is probably in another unit."""


def unusual_numbers(scene_file: SceneFile, text: str = "", source: str = "") -> tuple[str, ...]:
    """A sentence for each such number, with the remedy; with its line if the text of the file is given."""
    data = scene_file.model_dump(mode="python", exclude_none=True)
    lines = key_lines(text)
    return tuple(_sentences(data, lines, f"{source}, " if source else ""))


def _sentences(data: Mapping[str, object], lines: Mapping[Location, int], source: str) -> Iterator[str]:
    for path, key_path in Parts(data).keys.items():
        if "." not in path:
            continue
        table, *numbers, key = location_of(key_path)
        owner = data[str(table)]
        if numbers and isinstance(owner, list) and isinstance(numbers[0], int):
            owner = owner[numbers[0]]
        written = owner.get(key) if isinstance(owner, dict) else None
        if not isinstance(written, Decimal):
            continue
        advice = _core.unusual(path, float(written), float(split_key(str(key))[1].si))
        if advice:
            line = lines.get(location_of(key_path))
            head = f"[[{table}]]" if numbers else f"[{table}]"
            where = f"line {line}: {head} {key}" if line else key_path
            yield f"{source}{where} = {written} is unusual. {advice}"

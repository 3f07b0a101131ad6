"""Makes recordings with an invalid description and a right checksum, which a reader must reject with a message."""

import copy
import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
from punctura.record.header import KEY, with_check_sum
from punctura.record.stream import Decoder, check_sum

# Values that are valid for few fields or none. 1e999 stands for a number that a float cannot hold.
WRONG: tuple[Any, ...] = (
    None, True, 0, -1, 1.5, 10**30, 10**400, 1e999, "", "text", "\ud800", [], [1], ["x"], [[]], [{}], {}, {"x": 1},
    {"x": None},
)  # fmt: skip


def description_of(path: Path) -> dict[str, Any]:
    """The JSON of a recording's description, finished or not."""
    data: dict[str, Any] = json.loads(_schemas(path)[0].metadata[KEY])
    return data


def fields(data: Any, before: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The place of each value in a description, as keys and indices."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*before, key)
        yield from fields(value, (*before, key))


def changed(data: dict[str, Any], place: tuple[Any, ...], value: Any) -> dict[str, Any]:
    """A copy with another value at the given place."""
    result = copy.deepcopy(data)
    inner: Any = result
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value
    return result


def spoil_description(data: dict[str, Any], chance: random.Random) -> Any:
    """A description with one to three fields changed or removed, or rarely another value as a whole."""
    if chance.random() < 0.05:
        return chance.choice(WRONG)
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        place = chance.choice(list(fields(data)))
        data = changed(data, place, chance.choice(WRONG))
        if chance.random() < 0.2:
            inner: Any = data
            for key in place[:-1]:
                inner = inner[key]
            del inner[place[-1]]
    return data


def rewrite(source: Path, target: Path, description: Any) -> None:
    """Writes the recording `source` with another description and right checksums to `target`."""
    if is_parquet(source):
        table = pq.read_table(source)
        schema = _described(table.schema, description)
        pq.write_table(table.cast(schema.remove_metadata()).replace_schema_metadata(schema.metadata), target)
        return
    with pa.OSFile(str(source), "rb") as file, target.open("wb") as out:
        decoder = Decoder(file, source.stat().st_size)
        writer, streams = None, 0
        for batch in decoder:
            if streams < len(decoder.schemas):
                streams = len(decoder.schemas)
                schema = _described(decoder.schemas[-1], description)
                writer = pa.ipc.new_stream(out, schema)
            assert writer is not None
            batch = batch.replace_schema_metadata(schema.metadata)
            writer.write_batch(batch, custom_metadata={b"crc32": check_sum(batch)})


def is_parquet(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(4) == b"PAR1"


def _described(schema: pa.Schema, description: Any) -> pa.Schema:
    text = json.dumps(description).replace("Infinity", "1e999")  # ASCII keeps a lone surrogate as an escape
    return schema.with_metadata(with_check_sum(text.encode(), schema))


def _schemas(path: Path) -> list[pa.Schema]:
    if is_parquet(path):
        return [pq.read_schema(path)]
    with pa.OSFile(str(path), "rb") as file:
        decoder = Decoder(file, path.stat().st_size)
        for _ in decoder:
            break
        return decoder.schemas

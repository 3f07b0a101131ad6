"""Reads recordings of ROS (a .bag file, an .mcap file, a folder of ROS 2), by rosbags."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from punctura.extras import optional
from punctura.trace.table import Table, check_size, unreadable
from punctura.trace.trace import TraceError

_LONGEST_LIST = 16  # numbers of a message, such as those of joints


def is_bag(path: Path) -> bool:
    """Whether it is a recording of ROS, by its name; one of ROS 2 is a folder with a description."""
    return path.suffix.lower() in (".bag", ".mcap", ".db3") or (path / "metadata.yaml").is_file()


def read_bag(path: Path) -> Table:
    """The numbers of all messages, at the times of the topic that has most. Raises TraceError, OSError.

    Between the messages of another topic its numbers are interpolated. The time is that of the header, or of the
    recording; the units of ROS are not in its files.
    """
    reader_of = optional("rosbags.highlevel", "formats", f"{path}: a ROS bag").AnyReader
    from rosbags.typesys import Stores, get_typestore

    topics: dict[str, list[dict[str, float]]] = {}
    try:
        with reader_of([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
            for connection, stamp, raw in reader.messages():
                row = dict(_numbers("", reader.deserialize(raw, connection.msgtype)))
                seconds = row.pop("header.stamp.sec", 0.0) + 1e-9 * row.pop("header.stamp.nanosec", 0.0)
                rows = topics.setdefault(connection.topic, [])
                rows.append({"time [s]": seconds or 1e-9 * stamp} | row)
                check_size(path, len(rows), len(row))
    except TraceError:
        raise
    except Exception as error:  # rosbags raises many types for a damaged file
        raise unreadable(path, "ROS bag", error) from None
    return _joined(path, topics)


def _joined(path: Path, topics: dict[str, list[dict[str, float]]]) -> Table:
    if not topics:
        raise TraceError(f"{path}: holds no messages")
    held = {topic: {key: np.array([row.get(key, np.nan) for row in rows]) for key in rows[0]}
            for topic, rows in topics.items()}  # fmt: skip
    times = {topic: columns.pop("time [s]") for topic, columns in held.items()}
    time = times[max(times, key=lambda topic: len(times[topic]))]
    first, last = max(each[0] for each in times.values()), min(each[-1] for each in times.values())
    time = time[(time >= first) & (time <= last)]
    table = Table({"time [s]": time - time[0] if len(time) else time})
    for topic, columns in held.items():
        for key, values in columns.items():
            shared = sum(key in others for others in held.values()) > 1
            table[f"{topic} {key}" if shared or key == "data" else key] = np.interp(time, times[topic], values)
    return table


def _numbers(name: str, value: Any) -> Iterator[tuple[str, float]]:
    """The numbers in a message with their names: `wrench.force.z`, `position.0`."""
    before = f"{name}." if name else ""
    if dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            if not field.name.startswith("__"):
                yield from _numbers(before + field.name, getattr(value, field.name))
    elif isinstance(value, (int, float, np.number)) and not isinstance(value, bool):
        yield name, float(value)
    elif isinstance(value, (np.ndarray, list)) and len(value) <= _LONGEST_LIST:
        for i, part in enumerate(value):
            yield from _numbers(f"{before}{i}", part)

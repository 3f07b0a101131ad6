"""From the file that grew to the one that stays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyarrow as pa

from punctura.record.append_file import AppendFile
from punctura.record.parquet_file import parquet_output
from punctura.record.part_file import PartFile
from punctura.record.status import RecorderStatus

_SUFFIX = ".part"


def part_path(path: Path) -> Path:
    """Where a recording grows until it is finished."""
    return path.with_name(path.name + _SUFFIX)


def save_finished(
    part: PartFile, path: Path, more: dict[str, Any], progress: Callable[[float], None] | None = None
) -> None:
    """Parquet from what a growing file holds. Constant memory."""
    summary = part.survey.to_dict()
    summary |= {"notes": part.notes, "damaged": part.damaged}
    lost = more.get("lost", {})
    summary["lost"] = max(summary["lost"], sum(lost.values()))
    with parquet_output(path, part.schema, part.info.data | {"summary": summary} | more) as output:
        for batch in part.batches(progress):
            output.write(batch)


def finish_recording(path: Path, file: AppendFile, status: RecorderStatus, more: dict[str, Any]) -> RecorderStatus:
    """Closes the file and turns it into Parquet; whatever fails, the ticks that are on the disk stay there."""
    part = part_path(path)
    trouble = status.trouble
    try:
        file.close()
        if not trouble and path.exists():
            trouble = f"{path} has appeared meanwhile"
        if not trouble:
            lost = {"ring": status.lost_in_ring, "backlog": status.lost_in_backlog}
            save_finished(PartFile(part), path, more | {"lost": lost})
            size = path.stat().st_size
            part.unlink()
            return replace(status, file=path, finished=True, bytes=size)
    except (OSError, ValueError, pa.ArrowException) as bad:
        trouble = f"it could not be turned into Parquet: {bad}"
    stays = f"the recording is in {part}, readable up to tick {status.last_tick}"
    return replace(status, trouble=f"{trouble}; {stays}")

"""From the file that grew to the one that stays."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyarrow as pa

from punctura.record.append_file import Amiss, AppendFile
from punctura.record.errors import RecordingError
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
    summary |= {"notes": [*part.notes, *more.pop("notes", [])], "damaged": part.damaged}
    summary["lost"] = max(summary["lost"], sum(more.get("lost", {}).values()))
    with parquet_output(path, part.schema, part.info.data | {"summary": summary} | more, replace=False) as output:
        for batch in part.batches(progress):
            output.write(batch)


def finish_recording(
    path: Path, file: AppendFile, made: int, status: RecorderStatus, after: dict[str, Any]
) -> RecorderStatus:
    """Turns the file into Parquet and closes it; whatever fails, the ticks that are on the disk stay there.

    made: ticks of the loop since the recording began. Those that cannot be read in the end are lost, whatever the
    reason is. after: what the header says besides.
    """
    trouble, part, amiss, written = status.trouble, None, None, status.rows
    try:
        file.settle()
        amiss = file.amiss()
        trouble = amiss.words if amiss else trouble
        part = PartFile(file.source())
        rows = part.survey.rows
        status = replace(_counted(status, rows, part.survey.last_tick, made), file=file.place())
        if rows < written and not trouble:  # no memory, perhaps: what was not read now must not be deleted
            trouble = f"only {rows} of the {written} ticks in the file could be read"
        if not trouble:
            save_finished(part, path, after | {"lost": _causes(status), "notes": status.notes})
            file.close()
            with suppress(OSError):  # it is finished all the same
                part.path.unlink()
            return replace(status, file=path, finished=True, bytes=path.stat().st_size)
    except FileExistsError:
        trouble = f"{path} has appeared meanwhile"
    except (OSError, ValueError, MemoryError, pa.ArrowException) as bad:
        trouble = trouble or f"it could not be turned into Parquet: {str(bad) or type(bad).__name__}"
        if not part and _is_spoiled(bad, amiss):
            status = _counted(status, 0, -1, made)
        elif not part:  # the ticks are on the disk, whatever kept us from reading them
            status = replace(_counted(status, written, status.last_tick, made), file=file.place())
    finally:
        file.close()
    if not status.rows:
        return replace(status, trouble=f"{trouble}; nothing of it can be read")
    place = status.file or "the file that was moved; this system does not report its present name"
    stays = f"the recording is in {place}" + (f", readable up to tick {status.last_tick}" if part else "")
    source = shlex.quote(str(status.file)) if status.file else "MOVED_FILE"
    how = f"punctura export {source} --out FILE.parquet finishes it"
    return replace(status, trouble=f"{trouble}; {stays}; {how}")


def _is_spoiled(bad: BaseException, amiss: Amiss | None) -> bool:
    """Whether the reason is the file itself, and not a lack of memory or of open files."""
    return isinstance(bad, (RecordingError, FileNotFoundError)) or (amiss is not None and amiss.lost)


def _counted(status: RecorderStatus, rows: int, last_tick: int, made: int) -> RecorderStatus:
    """With what the file really holds, all that is lost of so many ticks, and a note that says why."""
    lost = max(0, made - rows)
    otherwise = max(0, lost - status.lost_in_ring - status.lost_in_backlog)
    status = replace(status, rows=rows, last_tick=last_tick, lost=lost, lost_otherwise=otherwise)
    return replace(status, notes=[*status.notes, _in_words(status, made)]) if lost else status


def _causes(status: RecorderStatus) -> dict[str, int]:
    """What is lost, for the header."""
    return {"ring": status.lost_in_ring, "backlog": status.lost_in_backlog, "other": status.lost_otherwise}


def _in_words(status: RecorderStatus, made: int) -> str:
    reasons = (
        (status.lost_in_ring, "came faster than they could be taken"),
        *((count, f"could not be written: {cause}") for cause, count in status.unwritten.items()),
        (status.lost_otherwise, "were lost otherwise"),
    )
    why = ", ".join(f"{count} {reason}" for count, reason in reasons if count)
    return f"{status.lost} of {made} ticks are lost: {why}"

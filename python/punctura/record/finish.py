"""The status of a recording, and the conversion of the growing .part file to the final Parquet file."""

import shlex
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from punctura.defects import explain
from punctura.record.append_file import AppendFile, FileChange
from punctura.record.description import DeviceAfter, RecordingError
from punctura.record.parquet_file import parquet_output
from punctura.record.part_file import PartFile


@dataclass(frozen=True)
class RecorderStatus:
    """The status at one moment. `trouble` describes the present problem; empty if none."""

    file: Path | None  # present path of the recording; None if it was moved and the system does not report where
    finished: bool = False  # the file is whole
    rows: int = 0  # ticks on the disk
    last_tick: int = -1  # number of the last tick on the disk
    bytes: int = 0  # written
    lost: int = 0  # ticks that will never be in the file
    lost_in_ring: int = 0  # of `lost`: the ring was full
    lost_in_backlog: int = 0  # of `lost`: not written, because the disk was too slow, full or gone
    lost_other: int = 0  # of `lost`: a defect, no memory, or a file changed by others; set at the end
    unwritten: dict[str, int] = field(default_factory=dict)  # lost_in_backlog by cause
    waiting_bytes: int = 0  # not yet written
    slowest_write_s: float = 0.0  # of a block
    trouble: str = ""
    fact: str = ""  # of `trouble`: what is wrong, without where the ticks are; set at the end
    notes: list[str] = field(default_factory=list)  # for the user

    @property
    def words(self) -> str:
        """The message for the user: the trouble or the number of lost ticks; empty if neither."""
        return self.trouble or (f"{self.lost} ticks are lost" if self.lost else "")


_SUFFIX = ".part"


def part_path(path: Path) -> Path:
    """Path of the file that an unfinished recording is written to."""
    return path.with_name(path.name + _SUFFIX)


def finished_path(path: Path) -> Path:
    """Path of the finished recording of a .part file; any other path stays as it is."""
    return path.with_name(path.name.removesuffix(_SUFFIX))


def save_finished(part: PartFile, path: Path, device: DeviceAfter, lost: dict[str, int], notes: Sequence[str]) -> None:
    """Writes the content of a .part file as Parquet, in constant memory.

    For the header: the device's report after the run and the lost ticks by cause; notes: for its summary.
    """
    summary = part.survey.summary([*part.notes, *notes], part.damaged).model_dump()
    summary["lost"] = max(summary["lost"], sum(lost.values()))
    data = {**part.info.data, "summary": summary, "device_after": device.model_dump(), "lost": lost}
    with parquet_output(path, part.schema, data, replace=False) as output:
        for batch in part.batches():
            output.write(batch)


def finish_recording(
    path: Path, file: AppendFile, made: int, status: RecorderStatus, device: DeviceAfter
) -> RecorderStatus:
    """Converts the file to Parquet and closes it. If anything fails, the ticks on the disk are kept.

    made: number of ticks of the loop since the recording began. Ticks that cannot be read back count as lost.
    device: its report after the run, for the header.
    """
    trouble, part, change, written = status.trouble, None, None, status.rows
    try:
        file.settle()
        change = file.change()
        trouble = change.words if change else trouble
        part = PartFile(file.source())
        rows = part.survey.rows
        status = replace(_counted(status, rows, part.survey.last_tick, made), file=file.place())
        if rows < written and not trouble:  # out of memory? Keep the file: it holds unread ticks
            trouble = f"only {rows} of the {written} ticks in the file could be read"
        if not trouble:
            save_finished(part, path, device, _causes(status), status.notes)
            file.close()
            with suppress(OSError):  # the Parquet file is complete in any case
                part.path.unlink()
            return replace(status, file=path, finished=True, bytes=path.stat().st_size)
    except FileExistsError:
        trouble = f"{path} was created by another program during the recording"
    except Exception as bad:
        trouble = trouble or f"conversion to Parquet failed: {explain(bad)}"
        if not part and _is_spoiled(bad, change):
            status = _counted(status, 0, -1, made)
        elif not part:  # the ticks are still on the disk, even if reading them failed
            status = replace(_counted(status, written, status.last_tick, made), file=file.place())
    finally:
        file.close()
    if not status.rows:
        return replace(status, fact=trouble, trouble=f"{trouble}; no tick of the recording can be read")
    place = status.file or "the moved file; this system does not report its new path"
    stays = f"the recording is in {place}" + (f", readable up to tick {status.last_tick}" if part else "")
    source = shlex.quote(str(status.file)) if status.file else "MOVED_FILE"
    how = f"to finish it, run: punctura export {source} --out FILE.parquet"
    return replace(status, fact=trouble, trouble=f"{trouble}; {stays}; {how}")


def _is_spoiled(bad: BaseException, change: FileChange | None) -> bool:
    """Whether the file itself is the cause, rather than a lack of memory or of file descriptors."""
    return isinstance(bad, (RecordingError, FileNotFoundError)) or (change is not None and change.lost)


def _counted(status: RecorderStatus, rows: int, last_tick: int, made: int) -> RecorderStatus:
    """The status with the true number of ticks in the file, the number lost of `made`, and a note with the causes."""
    lost = max(0, made - rows)
    other = max(0, lost - status.lost_in_ring - status.lost_in_backlog)
    status = replace(status, rows=rows, last_tick=last_tick, lost=lost, lost_other=other)
    return replace(status, notes=[*status.notes, _in_words(status, made)]) if lost else status


def _causes(status: RecorderStatus) -> dict[str, int]:
    """Number of lost ticks by cause, for the header."""
    return {"ring": status.lost_in_ring, "backlog": status.lost_in_backlog, "other": status.lost_other}


def _in_words(status: RecorderStatus, made: int) -> str:
    reasons = (
        (status.lost_in_ring, "came faster than they could be read"),
        *((count, f"could not be written: {cause}") for cause, count in status.unwritten.items()),
        (status.lost_other, "were lost for another reason"),
    )
    why = ", ".join(f"{count} {reason}" for count, reason in reasons if count)
    return f"{status.lost} of {made} ticks are lost: {why}"

"""Records every tick of a running loop."""

from __future__ import annotations

import errno
import os
import threading
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from types import TracebackType

import numpy as np
import pyarrow as pa

from punctura._core import Scene, ServoLoop, ThumbLoop
from punctura.defects import explain
from punctura.device_words import room_note
from punctura.record.append_file import AppendFile
from punctura.record.columns import raw_batch
from punctura.record.description import RecordingError
from punctura.record.finish import RecorderStatus, finish_recording, part_path
from punctura.record.header import describe_device, describe_run
from punctura.record.scene_log import SceneLog
from punctura.record.stream import Encoder
from punctura.record.writer import Backlog, Piece, Writer
from punctura.results import JsonObject
from punctura.ticks import COMMAND_SCENE, Ticks

INTERVAL_S = 0.1  # between two batches
_RING_S = 30.0  # of ticks, where 32 MB hold them: on a busy computer the reader may have to wait
_PRIORITY = 10  # of the reader under SCHED_FIFO, where the system permits it: below every device's
_BACKLOG_BYTES = 64 << 20  # about a minute at 1600 Hz
_ROWS_AT_ONCE = 4096  # maximum
_BATCH_BYTES = 8 << 20  # approximate
_ROWS_AT_LEAST = 64  # minimum, when memory is short
_MOST_FAILURES = 20  # in a row; then the thread waits until the next interval


class Recorder:
    """Records from before the loop starts until `finish`. Writes `path`.part, then converts it to `path`, Parquet.

    A tick only copies its snapshot into a ring. One thread empties the ring ten times a second, another one writes to
    the disk, so a slow or full disk cannot delay the loop. Lost ticks are counted, and the file holds the count.

        with Recorder(loop, "run.parquet") as recorder:
            loop.start()
            ...
            loop.stop()
        print(recorder.status())
    """

    def __init__(
        self,
        loop: ServoLoop,
        path: str | Path,
        capacity: int | None = None,
        about: JsonObject | None = None,
        thumb: ThumbLoop | None = None,
    ) -> None:
        """Call before loop.start(). capacity: number of snapshots in the ring, by default 30 s of ticks; 32 MB at most,
        and a note in the file says if it was reduced. about: further JSON data for the file's description. thumb: the
        loop of a second device, which is described, too.

        Raises RecordingError if the file cannot be written.
        """
        self.path = Path(path)
        self._part = part_path(self.path)
        if loop.running:
            raise RecordingError("the loop is already running: create the Recorder before loop.start()")
        self._loop, self._thumb = loop, thumb
        self._header = describe_run(loop, about, thumb)
        self._encoder = Encoder(self._header)
        self._scenes = SceneLog(loop)
        self._listener = loop.listen(int(_RING_S * loop.device.info.rate) if capacity is None else capacity)
        self._backlog = Backlog(_BACKLOG_BYTES)
        self._began = self._next_tick = int(loop.report()["ticks"])  # the next tick to come, if none is missing
        self._width = len(loop.scene.membranes)  # number of membranes in the columns of the present stream
        self._kept = 0  # ticks put into the backlog
        self._carried: list[str] = []  # scenes of lost ticks, written with the next kept tick
        self._unwritten: dict[str, int] = {}  # ticks that could not be written, by cause
        self._defect = ""
        self._final: RecorderStatus | None = None
        self._stop = threading.Event()
        self._reader = threading.Thread(target=self._read, name="punctura-recorder-reader", daemon=True)
        self._file = self._open()
        try:
            self._writer = Writer(self._file, self._backlog, self._part)
            if self._file.aside:
                self._writer.note(f"a damaged file without readable ticks was renamed to {self._file.aside}")
            if capacity is not None and self._listener.capacity < capacity:
                self._writer.note(
                    f"the ring was reduced from {capacity} to {self._listener.capacity} snapshots: it takes 32 MB at "
                    "most. Ticks that come while it is full are lost and counted"
                )
            if note := room_note(loop):
                self._writer.note(note)
            self._reader.start()
        except BaseException:  # also for KeyboardInterrupt: leave no file without ticks behind
            self._file.discard()
            raise

    def __repr__(self) -> str:
        return f"<Recorder of {str(self.path)!r}: {self.status()}>"

    def exchange(self, scene: Scene) -> None:
        """Calls loop.exchange(scene), and records the scene with the tick that takes it."""
        self._scenes.exchange(scene)

    def status(self) -> RecorderStatus:
        """The present status. Any thread may call it."""
        if self._final is not None:
            return self._final
        in_ring, unwritten = int(self._listener.lost), dict(self._unwritten)
        dropped = sum(unwritten.values())
        missing = self._next_tick - self._began - self._kept  # ticks missing before the last one in the backlog
        return RecorderStatus(
            file=self._writer.place,
            rows=self._writer.rows,
            last_tick=self._writer.last_tick,
            bytes=self._writer.size,
            lost=max(in_ring + dropped, missing) + self._writer.ruined,
            lost_in_ring=in_ring,
            lost_in_backlog=dropped,
            unwritten=unwritten,
            waiting_bytes=self._backlog.waiting_bytes,
            slowest_write_s=self._writer.slowest_s,
            trouble=self._writer.trouble or self._defect,
            notes=list(self._writer.notes),
        )

    def finish(self) -> RecorderStatus:
        """Call after loop.stop(). Writes the remaining ticks and converts the file to Parquet.

        Reports a failing disk in `trouble` instead of raising. Afterwards each tick of the loop since the recording
        began is a row or is counted as lost.
        """
        if self._final is None:
            made = int(self._loop.report()["ticks"]) - self._began
            self._stop.set()
            self._reader.join()
            self._backlog.put(Piece(self._encoder.end(), 0, -1))
            self._backlog.close()
            self._writer.join()
            if rows := self._backlog.rows():
                self._drop(rows)
            if self._defect:
                self._writer.note(self._defect)
            status = replace(self.status(), trouble=self._writer.trouble)
            after = describe_device(self._loop.device, self._thumb)
            self._final = finish_recording(self.path, self._file, made, status, after)
        return self._final

    def __enter__(self) -> Recorder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.finish()

    def _open(self) -> AppendFile:
        """Writes description and columns before the file gets its name, so it opens even after an immediate kill."""
        if self.path.suffix.lower() != ".parquet":
            raise RecordingError(f"{self.path}: the name of a recording must end in .parquet")
        if self.path.exists():
            raise RecordingError(f"{self.path} already exists, and a recording overwrites no file. Choose another name")
        first = self._encoder.begin(self._batch(self._listener.read(0)).schema)
        try:
            return AppendFile(self._part, first)
        except FileExistsError:
            raise RecordingError(
                f"{self._part} already exists: a recording that was not finished or is still running. "
                f"Save it with `punctura export {self._part} --out FILE.parquet`, or delete it"
            ) from None
        except OSError as bad:
            what = "written" if bad.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG) else "made"
            raise RecordingError(f"{self._part} cannot be {what}: {bad.strerror}") from None

    def _read(self) -> None:
        if hasattr(os, "sched_setscheduler"):
            with suppress(OSError):  # without the right to it
                os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(_PRIORITY))
        while not self._stop.wait(INTERVAL_S):
            self._empty_ring()
        self._empty_ring()

    def _empty_ring(self) -> None:
        """Reads all snapshots from the ring. A failure loses only the ticks of its batch, and they are counted."""
        limit, failures = self._rows_at_once(), 0
        while failures < _MOST_FAILURES:
            try:
                if self._take(limit) < limit:
                    return
            except BaseException as bad:
                self._defect = f"ticks could not be recorded: {explain(bad)}"
                limit, failures = max(_ROWS_AT_LEAST, limit // 2), failures + 1

    def _rows_at_once(self) -> int:
        """Rows per batch, bounded in memory for any number of membranes."""
        columns = len(self._encoder.schema or ())
        return max(_ROWS_AT_LEAST, min(_ROWS_AT_ONCE, _BATCH_BYTES // (8 * max(1, columns))))

    def _take(self, limit: int) -> int:
        """Moves one batch from the ring to the backlog and returns its number of ticks."""
        snapshots = self._listener.read(limit)
        n = len(snapshots["tick"])
        if n:
            scenes = self._taken(snapshots)
            kept = False
            try:
                kept = self._keep(snapshots, scenes)
            finally:  # if this batch is lost, the next kept batch records the gap before it
                self._carried = [] if kept else [scene for row in scenes if row for scene in row]
            if kept:
                self._next_tick = int(snapshots["tick"][-1]) + 1
                self._kept += n
            else:
                self._drop(n)
        return n

    def _drop(self, rows: int) -> None:
        cause = self._writer.why_unwritten or "the disk was too slow"
        self._unwritten[cause] = self._unwritten.get(cause, 0) + rows

    def _keep(self, snapshots: Ticks, scenes: list[list[str] | None]) -> bool:
        """Puts one batch into the backlog. Returns False if it does not fit."""
        batch = self._batch(snapshots, scenes)
        return self._backlog.put(Piece(self._encoder.batch(batch), len(batch), int(snapshots["tick"][-1])))

    def _batch(self, snapshots: Ticks, scenes: list[list[str] | None] | None = None) -> pa.RecordBatch:
        """The batch in the file's columns. Starts a new stream if it has more columns than the present one."""
        self._width = max(self._width, snapshots.membrane_count)
        gap = np.diff(snapshots["tick"].astype(np.int64), prepend=self._next_tick - 1) - 1
        batch = raw_batch(snapshots, self._width, gap.astype(np.uint32), scenes or [])
        if self._encoder.schema is not None and batch.schema.names != self._encoder.schema.names:
            self._backlog.put(Piece(self._encoder.begin(batch.schema), 0, -1))
        return batch

    def _taken(self, snapshots: Ticks) -> list[list[str] | None]:
        """For each tick the scenes that it took, None if it took none."""
        scenes: list[list[str] | None] = [None] * len(snapshots["tick"])
        for k in np.flatnonzero(snapshots["commands"] & COMMAND_SCENE):
            scenes[k] = self._scenes.taken(int(snapshots["tick"][k]))
        if self._carried:
            scenes[0] = self._carried + (scenes[0] or [])
        return scenes

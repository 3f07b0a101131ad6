"""A participant's session on disk: one line of JSON for each answered trial, before the next one begins."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterable, Sequence
from datetime import datetime, timezone
from pathlib import Path

from pydantic import BaseModel, NonNegativeInt, ValidationError

from punctura import PuncturaError, __version__
from punctura.errors import FREE_SPACE, is_full
from punctura.files.whole_file import private, private_folder, sync
from punctura.perception.course import Course, Line, Trial, line_of
from punctura.perception.protocol import Protocol
from punctura.perception.stimulus import Felt
from punctura.record import RecordingError, open_recording
from punctura.record.new_file import in_use, lock

_PSEUDONYM = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}")
SUFFIX = ".jsonl"
TABLES = ("trials.csv", "trials.parquet", "dictionary.csv")
WRITTEN = ("report.md", "report.html", "functions.svg", "results.json", *TABLES)  # by the analysis


class SessionError(PuncturaError):
    """A session cannot begin or go on; the text says why and what to do."""


class DiskFullError(SessionError):
    """An answer is not on disk yet. Free some space, and give the same answer again: `Session.add`."""


class Header(BaseModel, frozen=True):
    """The first line of a session."""

    protocol: str  # its name
    digest: str  # of the protocol
    participant: str
    number: NonNegativeInt  # of the participant: decides the order
    simulated: bool = False
    device: str = ""  # its model; empty for an observer
    device_simulated: bool = False  # then no hand felt a force
    version: str  # of Punctura
    began: str = ""  # ISO 8601, UTC
    consent: bool = False
    consented: str = ""  # to which text, as it was read, with the answer; at `began`


def agreed(protocol: Protocol, folder: Path, participant: str) -> bool:
    """Whether the participant has agreed in a part of the session that is on disk.

    Raises SessionError if no session of this protocol and participant can be in the folder.
    """
    path = _path(folder, participant)
    header, _ = read_session(path) if path.exists() else (None, [])
    if header:
        check_header(header, protocol, path)
    _free_number({*sessions(folder)} - {path}, simulated=False)
    return header is not None and header.consent


def _path(folder: Path, participant: str) -> Path:
    """Raises SessionError for a wrong pseudonym."""
    if not _PSEUDONYM.fullmatch(participant):
        raise SessionError(
            f"{participant!r} is no pseudonym: give letters, digits, - and _, at most 40, such as P01; no name"
        )
    return folder / f"{participant}{SUFFIX}"


class Session:
    """Trials of one participant. A session that was interrupted goes on with the trial after the last whole line.

    with Session(protocol, folder, "P01") as session:
        while trial := session.next():
            ...
            session.add(trial, "first", felt)
    """

    def __init__(
        self, protocol: Protocol, folder: Path, participant: str, consent: bool = False, simulated: bool = False,
        device: str = "", device_simulated: bool = False,
    ) -> None:  # fmt: skip
        """simulated: whether an observer answers; a folder has people or observers.

        Raises SessionError for a wrong pseudonym, another protocol or device, or a file that another process uses.
        """
        self.path = _path(folder, participant)
        if protocol.file.consent and not consent:
            raise SessionError("the participant has not agreed to the text of the protocol's key consent")
        private_folder(folder)
        others = set(sessions(folder)) - {self.path}
        self._descriptor = private(str(self.path), os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0))
        try:
            if lock(self._descriptor) is False:
                raise SessionError(f"{self.path}: another program runs this participant's session")
            header, lines = read_session(self.path)  # before the file is changed, which may be no session
            os.ftruncate(self._descriptor, self.path.read_bytes().rfind(b"\n") + 1)  # what a kill left of a last line
            if header is None:
                header = Header(
                    protocol=protocol.name, digest=protocol.digest, participant=participant, version=__version__,
                    number=_free_number(others, simulated), simulated=simulated, began=_now(),
                    device=device, device_simulated=device_simulated, consent=bool(protocol.file.consent),
                    consented="" if simulated else protocol.consented,
                )  # fmt: skip
                self._append(header)
            check_header(header, protocol, self.path)
            if header.device not in ("", device):
                raise SessionError(f"{self.path} began on {header.device}, and this is {device}: choose with --device")
            self.header, self.course = header, replayed(protocol, header, lines, self.path)
        except BaseException:
            os.close(self._descriptor)
            raise
        self.kept = self.course.at  # trials from before

    def __repr__(self) -> str:
        return f"<Session {self.path.stem}>"

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._descriptor)

    def next(self) -> Trial | None:
        """The next trial; None after the last one."""
        return self.course.next()

    def add(self, trial: Trial, answer: str, felt: Sequence[Felt], recordings: Sequence[str] = ()) -> None:
        """Writes the answer to `next` to the disk, and only then goes on. Raises DiskFullError, OSError.

        What a loss of power must not take, too: the recordings, which are finished, and the names of all files.
        """
        for file in (*(self.path.parent / name for name in recordings), self.path.parent):
            sync(file)
        self._append(line_of(trial, answer, felt, recordings, _now()))
        self.course.add(trial, answer)

    def _append(self, line: BaseModel) -> None:
        size = os.lseek(self._descriptor, 0, os.SEEK_END)
        data = (line.model_dump_json() + "\n").encode()
        try:
            while data:
                data = data[os.write(self._descriptor, data) :]
            os.fsync(self._descriptor)
        except OSError as bad:
            os.ftruncate(self._descriptor, size)
            if is_full(bad):
                text = f"{self.path}: the disk is full, and this answer is not saved; {FREE_SPACE}"
                raise DiskFullError(text) from None
            raise


def check_header(header: Header, protocol: Protocol, path: Path) -> None:
    """Raises SessionError if a session is not one of this protocol."""
    for key, wanted in (("protocol", protocol.name), ("digest", protocol.digest)):
        if (found := getattr(header, key)) != wanted:
            raise SessionError(
                f"{path} is a session of another protocol or of a changed one ({key} {found!r}, now {wanted!r}; it "
                f"began with Punctura {header.version}): give the same protocol again, or another folder"
            )
    if header.participant != path.stem:
        raise SessionError(f"{path} is the session of {header.participant}: give the file its old name")


def replayed(protocol: Protocol, header: Header, lines: Sequence[Line], path: Path) -> Course:
    """The course after these trials. Raises SessionError with the first value that is not the planned one."""
    course = Course(protocol, header.number)
    for number, line in enumerate(lines, 2):
        if (trial := course.next()) is None:
            raise _not_planned(header, path, number, "is after the last trial")
        planned = line_of(trial, line.answer, line.felt)
        for key in ("trial", "block", "kind", "level", "position"):
            if (found := getattr(line, key)) != (wanted := getattr(planned, key)):
                raise _not_planned(header, path, number, f"{key} is {found!r}, and {wanted!r} is planned")
        if len(line.felt) != protocol.intervals or not protocol.takes(line.answer):
            raise _not_planned(header, path, number, f"{line.answer!r} to {len(line.felt)} intervals is no answer")
        own = re.compile(rf"{re.escape(header.participant)}-{trial.number:04d}-\d+\.parquet")
        if others := [name for name in line.recordings if not own.fullmatch(name)]:
            raise _not_planned(header, path, number, f"{others[0]!r} is the name of another trial's recording")
        course.add(trial, line.answer)
    return course


def _not_planned(header: Header, path: Path, number: int, why: str) -> SessionError:
    other = f"use Punctura {header.version}, which began it, or " * (header.version != __version__)
    return SessionError(
        f"{path}, line {number}: {why}. It is not what seed, participant's number and answers give: {other}restore the "
        "file from a copy"
    )


def check_recordings(header: Header, lines: Sequence[Line], folder: Path) -> None:
    """Raises SessionError if a recording is one of another trial. A missing or a damaged one is none of another."""
    for line in lines:
        for file in (folder / name for name in line.recordings):
            with contextlib.suppress(RecordingError):
                about = open_recording(file).info.about
                if (found := (about.get("participant"), about.get("trial"))) != (header.participant, line.trial):
                    raise SessionError(
                        f"{file} is the recording of trial {found[1]} of {found[0]}, not of trial {line.trial} of "
                        f"{header.participant}: restore it from a copy"
                    )


def sessions(folder: Path) -> list[Path]:
    """The files of all sessions of a folder, by pseudonym."""
    return sorted(path for path in folder.glob(f"*{SUFFIX}") if _PSEUDONYM.fullmatch(path.stem))


def read_session(path: Path) -> tuple[Header | None, list[Line]]:
    """The header of a session and its trials, without a last line that is not whole. Raises SessionError, OSError.

    A kill may have left a file without a header.
    """
    header, lines = None, []
    for number, text in enumerate(path.read_bytes().splitlines(keepends=True), 1):
        if not text.endswith(b"\n"):
            break
        try:
            if header is None:
                header = Header.model_validate_json(text)
            else:
                lines.append(Line.model_validate_json(text))
        except ValidationError:
            raise SessionError(
                f"{path}, line {number}: is no line of this session; restore the file from a copy"
            ) from None
    return header, lines


def recordings(folder: Path, participant: str, trial: str = r"\d{4,}") -> list[Path]:
    """Also of a trial that was never answered, and what a kill left of one. trial: four digits; all if not given."""
    own = re.compile(rf"{re.escape(participant)}-{trial}-\d+\.parquet(\..+)?")
    return [file for file in folder.iterdir() if own.fullmatch(file.name)]


def delete_participant(folder: Path, participant: str) -> list[Path]:
    """Deletes all that the folder has of a participant, and what was computed from it; returns the paths.

    Raises SessionError if there is nothing, or if a program runs the participant's session: its later answers would
    be lost.
    """
    path = folder / f"{participant}{SUFFIX}"
    if not _PSEUDONYM.fullmatch(participant) or not path.is_file():
        raise SessionError(f"{folder} has no participant {participant!r}")
    if in_use(path):
        raise SessionError(f"{path}: another program runs this participant's session; end it first, and delete again")
    written = [file for name in WRITTEN if (file := folder / name).is_file()]
    found = [*sorted(recordings(folder, participant)), *written, path]
    for file in found:
        file.unlink()
    return found


def _free_number(paths: set[Path], simulated: bool) -> int:
    """The smallest number that no session has: it decides the participant's order. Raises SessionError."""
    headers = [header for path in paths if (header := read_session(path)[0])]
    check_alike(headers, simulated)
    used = {header.number for header in headers}
    return next(number for number in range(len(used) + 1) if number not in used)


def check_alike(headers: Iterable[Header], simulated: bool) -> None:
    """Raises SessionError if a session is not one of observers (simulated), or of people."""
    if any(header.simulated != simulated for header in headers):
        other = "people" if simulated else "simulated observers"
        raise SessionError(f"the folder has sessions of {other}, and no report may mix both: choose another --out")


def _now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="milliseconds")

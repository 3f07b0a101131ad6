"""A participant's session on disk: one line of JSON for each answered trial, before the next one begins."""

from __future__ import annotations

import errno
import json
import math
import os
import re
from collections.abc import Sequence
from datetime import datetime, timezone
from pathlib import Path

from punctura import PuncturaError, __version__
from punctura.files.whole_file import private, private_folder, sync
from punctura.perception.course import Course, Trial, line_of
from punctura.perception.protocol import Protocol
from punctura.perception.stimulus import Felt
from punctura.record.new_file import lock
from punctura.results import JsonObject

_PSEUDONYM = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}")
SUFFIX = ".jsonl"
TABLES = ("trials.csv", "trials.parquet", "dictionary.csv")
WRITTEN = ("report.md", "functions.svg", "results.json", *TABLES)  # by the analysis
_HEADER = {"participant", "number", "digest", "version"}
_LINE = {"trial", "block", "kind", "level", "position", "answer", "felt", "time"}


class SessionError(PuncturaError):
    """A session cannot begin or go on; the text says why and what to do."""


class DiskFullError(SessionError):
    """An answer is not on disk yet. Free some space, and give the same answer again: `Session.add`."""


def agreed(protocol: Protocol, folder: Path, participant: str) -> bool:
    """Whether the participant has agreed in a part of the session that is on disk.

    Raises SessionError if no session of this protocol and participant can be in the folder.
    """
    path = _path(folder, participant)
    lines = read_session(path) if path.exists() else []
    for header in lines[:1]:
        check_header(header, protocol, path)
    _free_number({*sessions(folder)} - {path}, simulated=False)
    return bool(lines and lines[0].get("consent"))


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
        self, protocol: Protocol, folder: Path, participant: str, consent: bool = False, simulated: bool = False
    ) -> None:
        """simulated: whether an observer answers; a folder has people or observers.

        Raises SessionError for a wrong pseudonym, another protocol, or a file that another process uses.
        """
        self.path = _path(folder, participant)
        if protocol.file.consent and not consent:
            raise SessionError("the participant has not agreed to the text of the protocol's key consent")
        private_folder(folder)
        before = set(sessions(folder))
        self._descriptor = private(str(self.path), os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0))
        try:
            if lock(self._descriptor) is False:
                raise SessionError(f"{self.path}: another program runs this participant's session")
            lines = self._whole_lines()
            if not lines:
                lines = [_header(protocol, participant, _free_number(before - {self.path}, simulated), simulated)]
                self._append(lines[0])
            self.header = lines[0]
            check_header(self.header, protocol, self.path)
            self.course = Course(protocol, int(self.header["number"]))
            for line in lines[1:]:
                self._repeat(line)
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
        self._append({**line_of(trial, answer, felt), "recordings": list(recordings), "time": _now()})
        self.course.add(trial, answer)

    def _append(self, line: JsonObject) -> None:
        size = os.lseek(self._descriptor, 0, os.SEEK_END)
        data = (json.dumps(line, ensure_ascii=False) + "\n").encode()
        try:
            while data:
                data = data[os.write(self._descriptor, data) :]
            os.fsync(self._descriptor)
        except OSError as bad:
            os.ftruncate(self._descriptor, size)
            if bad.errno in (errno.ENOSPC, errno.EDQUOT):
                raise DiskFullError(
                    f"{self.path}: the disk is full, and this answer is not saved: free some space, then go on"
                ) from None
            raise

    def _whole_lines(self) -> list[JsonObject]:
        """The lines of the file. What a kill left of a last one is cut off."""
        os.lseek(self._descriptor, 0, os.SEEK_SET)  # on Windows the lock has moved it
        with open(self._descriptor, "rb", closefd=False) as file:
            data = file.read()
        whole = data[: data.rfind(b"\n") + 1]
        lines = parsed(whole, self.path)  # before the file is changed, which may be no session
        os.ftruncate(self._descriptor, len(whole))
        return lines

    def _repeat(self, line: JsonObject) -> None:
        trial = self.course.next()
        if trial is None or (line["trial"], line["level"], line["position"]) != (
            trial.number, trial.shown.level, trial.position,
        ):  # fmt: skip
            raise SessionError(
                f"{self.path}: trial {line['trial']} is not the one that this version of Punctura would show; the "
                f"session began with {self.header['version']}: go on with that version"
            )
        self.course.add(trial, str(line["answer"]))


def check_header(header: JsonObject, protocol: Protocol, path: Path) -> None:
    """Raises SessionError if a session is not one of this protocol."""
    for key, wanted in (("protocol", protocol.name), ("digest", protocol.digest)):
        if header.get(key) != wanted:
            raise SessionError(
                f"{path} is a session of another protocol or of a changed one ({key} {header.get(key)!r}, now "
                f"{wanted!r}): give the same protocol again, or another folder"
            )
    if header["participant"] != path.stem:
        raise SessionError(f"{path} is the session of {header['participant']}: give the file its old name")


def check_lines(lines: Sequence[JsonObject], protocol: Protocol, path: Path) -> None:
    """Raises SessionError if a trial is none of the protocol: the file was changed by hand."""
    shown = {*protocol.levels, *([protocol.catch.level] if protocol.catch else [])}
    for number, line in enumerate(lines):
        try:
            numbers = [value for one in line["felt"] for value in vars(Felt(**one)).values()]
            sound = all(map(math.isfinite, numbers)) and len(line["felt"]) == protocol.intervals
            known = line["answer"] in protocol.answers if protocol.answers else float(line["answer"]) > 0
            sound &= known and line["position"] in range(protocol.intervals) and line["level"] in shown
            sound &= line["kind"] in ("practice", "trial", "catch") and line["block"] >= 0
        except (TypeError, ValueError):
            sound = False
        if not sound or line["trial"] != number:
            raise SessionError(f"{path}, line {number + 2}: is no trial of this session; restore the file from a copy")


def sessions(folder: Path) -> list[Path]:
    """The files of all sessions of a folder, by pseudonym."""
    return sorted(path for path in folder.glob(f"*{SUFFIX}") if _PSEUDONYM.fullmatch(path.stem))


def read_session(path: Path) -> list[JsonObject]:
    """The header of a session and its trials, without a last line that is not whole. Raises SessionError, OSError."""
    data = path.read_bytes()
    return parsed(data[: data.rfind(b"\n") + 1], path)


def parsed(data: bytes, path: Path) -> list[JsonObject]:
    """The lines of a session's file. Raises SessionError for any other file."""
    lines: list[JsonObject] = []
    for number, text in enumerate(data.splitlines(), 1):
        try:
            line = json.loads(text)
        except ValueError:
            line = None
        wanted = _HEADER if number == 1 else _LINE
        if not isinstance(line, dict) or not wanted <= line.keys():
            raise SessionError(f"{path}, line {number}: is no line of a session; restore the file from a copy")
        lines.append(line)
    return lines


def recordings(folder: Path, participant: str, trial: str = r"\d{4,}") -> list[Path]:
    """Also of a trial that was never answered, and what a kill left of one. trial: four digits; all if not given."""
    own = re.compile(rf"{re.escape(participant)}-{trial}-\d+\.parquet(\..+)?")
    return [file for file in folder.iterdir() if own.fullmatch(file.name)]


def delete_participant(folder: Path, participant: str) -> list[Path]:
    """Deletes all that the folder has of a participant, and what was computed from it; returns the paths.

    Raises SessionError if there is nothing.
    """
    path = folder / f"{participant}{SUFFIX}"
    if not _PSEUDONYM.fullmatch(participant) or not path.is_file():
        raise SessionError(f"{folder} has no participant {participant!r}")
    names = {str(name) for line in read_session(path)[1:] for name in line.get("recordings", ())}
    names |= {file.name for file in recordings(folder, participant)}
    names = {name for name in names if Path(name).name == name} | {*WRITTEN}
    found = [file for name in [*sorted(names), path.name] if (file := folder / name).is_file()]
    for file in found:
        file.unlink()
    return found


def _header(protocol: Protocol, participant: str, number: int, simulated: bool) -> JsonObject:
    return {
        "protocol": protocol.name,
        "digest": protocol.digest,
        "participant": participant,
        "number": number,
        "simulated": simulated,
        "version": __version__,
        "began": _now(),
        "consent": bool(protocol.file.consent),
    }


def _free_number(paths: set[Path], simulated: bool) -> int:
    """The smallest number that no session has: it decides the participant's order. Raises SessionError."""
    headers = [lines[0] for path in paths if (lines := read_session(path))]
    if any(header.get("simulated", False) != simulated for header in headers):
        other = "people" if simulated else "simulated observers"
        raise SessionError(f"the folder has sessions of {other}, and no report may mix both: choose another --out")
    used = {int(header["number"]) for header in headers}
    return next(number for number in range(len(used) + 1) if number not in used)


def _now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="milliseconds")

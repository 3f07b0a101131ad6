"""Saves results as JSON files in one folder."""

import os
import re
import secrets
import unicodedata
from collections.abc import Iterable
from pathlib import Path

from pydantic import ValidationError

from punctura._core import PuncturaError
from punctura.exercise.result import Result
from punctura.files.cells import csv_line, text_cell
from punctura.files.names import user_folder
from punctura.files.whole_file import private_folder, write_whole

_NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,119}")
_LARGEST = 20_000_000  # bytes; a result has some kilobytes

# Columns of the CSV table, with the unit in the name, as in `punctura simulate`.
COLUMNS = (
    "name", "person", "class", "exercise", "title", "scene", "date", "recording", "version", "passed", "not_measured",
    "reasons", "entries", "peak_force_N", "peak_felt_force_N", "force_scale", "felt_drop_N",
    "largest_overshoot_mm", "dwell_s", "longest_stay_s", "path_length_mm", "net_distance_mm", "straightness",
    "lateral_deviation_mm", "entry_angle_deg", "time_to_target_s", "total_time_s", "lost_ticks", "force_cut_s",
    "plunger_push_N", "plunger_felt_drop_N", "injected_mL",
)  # fmt: skip


class ResultsError(PuncturaError, ValueError):
    """A result does not exist or cannot be read, or a name is invalid."""


def default_folder() -> Path:
    """The operating system's folder for the user's data of this program."""
    return user_folder("data") / "results"


class ResultStore:
    """A folder of results. Nothing outside it is read or written; other files in it are not touched."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """The folder is created with the first result."""
        self.folder = Path(folder)

    def __repr__(self) -> str:
        return f"ResultStore({str(self.folder)!r})"

    def save(self, result: Result) -> Result:
        """Saves a result under a new name, and returns it with that name. Raises OSError."""
        private_folder(self.folder)  # it contains names of persons
        stem = "-".join(filter(None, (_slug(result.date[:19]), _slug(result.exercise)[:40], _slug(result.person)[:40])))
        while True:
            kept = result.model_copy(update={"name": f"{stem}-{secrets.token_hex(3)}"})
            path = self._path(kept.name)
            if not path.exists():
                break
        write_whole(path, kept.model_dump_json(indent=1).encode("utf-8"), replace=False, private=True)
        return kept

    def load(self, name: str) -> Result:
        """The saved result of this name. Raises ResultsError."""
        return self._read(self._path(name), name)

    def all(
        self, person: str | None = None, group: str | None = None, unread: list[ResultsError] | None = None
    ) -> list[Result]:
        """All results, or those of one person or class, latest first. Files that are not results are skipped.

        unread: takes the reasons for the files that were skipped.
        """
        results = []
        for path in sorted(self.folder.glob("*.json")) if self.folder.is_dir() else ():
            try:
                result = self._read(path, path.stem)
            except ResultsError as error:
                if unread is not None:
                    unread.append(error)
                continue
            if person in (None, result.person) and group in (None, result.group):
                results.append(result)
        return sorted(results, key=lambda result: (result.date, result.name), reverse=True)

    def people(self) -> list[str]:
        """The names of all persons with a result, sorted."""
        return sorted({result.person for result in self.all()} - {""}, key=str.casefold)

    def delete(self, name: str) -> None:
        """Deletes the saved result of this name. Raises ResultsError."""
        try:
            self._path(name).unlink()
        except FileNotFoundError:
            raise ResultsError(f"there is no result {name!r}") from None

    def _path(self, name: str) -> Path:
        if not _NAME.fullmatch(name):
            raise ResultsError(f"{name!r} is not a valid name of a result")
        return self.folder / f"{name}.json"

    def _read(self, path: Path, name: str) -> Result:
        try:
            if path.is_symlink() or not path.is_file():
                raise ResultsError(f"there is no result {name!r}")
            if path.stat().st_size > _LARGEST:
                raise ResultsError(f"{name} is too large for a result")
            result = Result.model_validate_json(path.read_bytes())
        except ValidationError as bad:
            first = bad.errors()[0]
            where = "".join(f"{part}: " for part in first["loc"])
            raise ResultsError(f"{name} is no result: {where}{first['msg']}") from None
        except OSError as bad:
            raise ResultsError(f"{name} cannot be read: {bad.strerror}") from None
        return result.model_copy(update={"name": path.stem})


def to_csv(results: Iterable[Result]) -> str:
    """One row per result. Text becomes no formula in a spreadsheet, see text_cell."""
    rows = (_row(result) for result in results)
    return "".join(map(csv_line, (COLUMNS, *([_cell(row[name]) for name in COLUMNS] for row in rows))))


def to_json(results: Iterable[Result]) -> str:
    """The complete results as a JSON list."""
    return "[" + ",\n".join(result.model_dump_json(indent=1) for result in results) + "]\n"


def _row(result: Result) -> dict[str, object]:
    m = result.metrics
    largest = max((one.distance for one in m.overshoot), default=None)
    row = {name: getattr(result, "group" if name == "class" else name) for name in COLUMNS[:10]}
    return row | {
        "not_measured": "; ".join(result.unmeasured),
        "reasons": " ".join(result.reasons),
        "entries": m.entries,
        "peak_force_N": m.peak_force,
        "peak_felt_force_N": m.peak_felt_force,
        "force_scale": m.force_scale,
        "felt_drop_N": min((loss.drop for loss in m.losses if loss.needed is not None), default=None),
        "largest_overshoot_mm": _times(largest, 1e3),
        "dwell_s": m.dwell,
        "longest_stay_s": m.longest_stay,
        "path_length_mm": _times(m.path_length, 1e3),
        "net_distance_mm": _times(m.net_distance, 1e3),
        "straightness": m.straightness,
        "lateral_deviation_mm": _times(m.lateral_deviation, 1e3),
        "entry_angle_deg": _times(m.entry_angle, 57.29577951308232),
        "time_to_target_s": m.time_to_target,
        "total_time_s": m.total_time,
        "lost_ticks": m.lost_ticks,
        "force_cut_s": sum(m.force_cut.values()),
        "plunger_push_N": m.yields[-1].push if m.yields else None,
        "plunger_felt_drop_N": m.yields[-1].loss.drop if m.yields and m.yields[-1].loss else None,
        "injected_mL": max((one.injected * 1e6 for one in m.yields), default=None),
    }


def _times(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor


def _cell(value: object) -> object:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return text_cell(value) if isinstance(value, str) else value


def _slug(text: str) -> str:
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode().lower()
    return re.sub(r"[^a-z0-9]+", "-", plain).strip("-")

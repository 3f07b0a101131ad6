"""Names of files as text, and the folder of the user's files."""

import os
import re
import sys
from pathlib import Path
from typing import Literal

# The endings of trace files in a folder and in the studio; any other file is read as text if it is named alone.
TRACE_ENDINGS = (
    ".csv", ".tsv", ".txt", ".tra", ".lvm", ".json", ".jsonl", ".parquet", ".mat", ".xlsx", ".xlsm", ".xls",
    ".h5", ".hdf5", ".tdms", ".bag",
)  # fmt: skip


def as_text(path: str | os.PathLike[str]) -> str:
    """A path as text that can be written anywhere: bytes that are no UTF-8 and control characters become marks."""
    return re.sub(r"[\x00-\x1f\x7f-\x9f]", "?", os.fsencode(path).decode("utf-8", "replace"))


def traces_in(folder: str | os.PathLike[str]) -> list[Path]:
    """The trace files of a folder, by name. Raises OSError, ValueError for a folder without traces."""
    paths = sorted(p for p in Path(folder).iterdir() if p.suffix.lower() in TRACE_ENDINGS and p.is_file())
    if not paths:
        raise ValueError(f"{folder}: holds no trace ({', '.join(TRACE_ENDINGS)})")
    return paths


def user_folder(kind: Literal["data", "state"]) -> Path:
    """Punctura's folder of this user. state: what may be lost, such as a log."""
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local") / "punctura"
    if sys.platform == "darwin":
        return Path.home() / "Library/Application Support/punctura"
    usual = {"data": ".local/share", "state": ".local/state"}[kind]  # XDG Base Directory Specification
    return Path(os.environ.get(f"XDG_{kind.upper()}_HOME", "").strip() or Path.home() / usual) / "punctura"

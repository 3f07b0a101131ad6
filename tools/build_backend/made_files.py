"""A folder in which a program changes only the files that it has made: their list stands in the folder."""

import hashlib
import json
import os
import shutil
import tempfile
from pathlib import Path, PurePosixPath

LIST = "punctura-files.json"  # each file that was made, with the SHA-256 of its content


class ForeignFileError(Exception):
    """A file of somebody else is in the way. The message says which one and what to do."""


def publish(made: Path, folder: Path) -> None:
    """Copies the files of `made` to `folder`, over those of an earlier time. Other files in `folder` stay.

    Raises ForeignFileError, and then nothing has changed; OSError.
    """
    new = {file.relative_to(made).as_posix(): _digest(file) for file in sorted(made.rglob("*")) if file.is_file()}
    old = _listed(folder)
    for name in {**old, **new}:
        _check(folder, name, old)
    if (folder / LIST).is_symlink():
        raise ForeignFileError(f"{folder / LIST} is a link; name a new or an empty folder")
    folder.mkdir(parents=True, exist_ok=True)
    # First both lists: if the copying ends half-way, the next time still knows every file.
    _write_list(folder, {name: [*old.get(name, []), digest] for name, digest in new.items()}, old)
    for name in set(old) - set(new):
        (folder / name).unlink(missing_ok=True)
        _remove_empty((folder / name).parent, folder)
    for name in new:
        _copy(made / name, folder / name)
    _write_list(folder, {name: [digest] for name, digest in new.items()}, {})


def _copy(file: Path, to: Path) -> None:
    """The file appears when it is complete, so that its digest is always one of the list."""
    to.parent.mkdir(parents=True, exist_ok=True)
    handle, new = tempfile.mkstemp(dir=to.parent, prefix=f".{to.name}.")
    os.close(handle)
    try:
        shutil.copyfile(file, new)
        shutil.copymode(file, new)
        os.replace(new, to)
    except BaseException:
        os.unlink(new)
        raise


def _check(folder: Path, name: str, old: dict[str, list[str]]) -> None:
    path = folder / name
    for part in [path, *path.parents][: len(PurePosixPath(name).parts)]:
        if part.is_symlink() or (part != path and part.exists() and not part.is_dir()):
            raise ForeignFileError(f"{part} is not of a static page. Move it away, or name a new or an empty folder")
    if path.exists() and (not path.is_file() or _digest(path) not in old.get(name, [])):
        what = "has been changed" if name in old else "is not of a static page"
        raise ForeignFileError(f"{path} {what}. Move it away, or name a new or an empty folder")


def _listed(folder: Path) -> dict[str, list[str]]:
    """The files that were made before, with the digests that they may have."""
    path = folder / LIST
    if not path.exists():
        return {}
    try:
        listed = json.loads(path.read_text(encoding="utf-8"))
        names = [PurePosixPath(name) for name in listed]
        sound = all(not name.is_absolute() and ".." not in name.parts for name in names)
    except (ValueError, TypeError):
        sound = False
    if not sound or not isinstance(listed, dict):
        raise ForeignFileError(f"{path} is not the list of a static page. Name a new or an empty folder")
    return listed


def _write_list(folder: Path, files: dict[str, list[str]], more: dict[str, list[str]]) -> None:
    (folder / LIST).write_text(json.dumps({**more, **files}, indent=0), encoding="utf-8")


def _remove_empty(folder: Path, top: Path) -> None:
    while folder != top and folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()

"""The folder of the exercises that were made in the page. A page cannot read or write files outside of it."""

import threading
from pathlib import Path

from punctura.exercise.exercise import Exercise, exercise_text
from punctura.files.whole_file import private_folder, write_whole
from punctura.studio.limits import MOST_OWN_EXERCISES, MOST_TEXT
from punctura.studio.names import BadName, safe_name


class NameExists(ValueError):
    """There is an exercise of this name, which the page may replace."""


class OwnExercises:
    """Usable from any thread. Links are not followed; files with other names than a page could give are left alone."""

    def __init__(self, folder: Path) -> None:
        """The folder is created with the first exercise."""
        self.folder = folder
        self._lock = threading.Lock()  # held from a check to the change that it allows

    def files(self) -> dict[str, Path]:
        """The files by name, in alphabetical order; with files that were copied here, more than MOST_OWN_EXERCISES."""
        found = {}
        for path in sorted(self.folder.glob("*.toml")) if self.folder.is_dir() else ():
            try:
                if safe_name(path.stem) == path.stem and not path.is_symlink() and path.is_file():
                    found[path.stem] = path
            except BadName:
                continue
        return found

    def save(self, name: str, exercise: Exercise, replace: bool) -> Path:
        """Saves an exercise under a name that no other kind of exercise has. Raises ValueError, OSError."""
        text = exercise_text(exercise.file).encode("utf-8")
        if len(text) > MOST_TEXT:
            raise ValueError(f"the file is larger than {MOST_TEXT} bytes")
        return self.keep(name, text, replace)

    def keep(self, name: str, text: bytes, replace: bool) -> Path:
        """The same with the text of a file, which was checked before."""
        path = self.folder / f"{safe_name(name)}.toml"
        if path.is_symlink():
            raise ValueError(f"{name} is a link; choose another name")
        with self._lock:
            known = self.files()
            if not replace and (path.exists() or path.stem in known):
                raise NameExists(f"there is an exercise {name} already; choose another name, or replace it")
            if path.stem not in known and len(known) >= MOST_OWN_EXERCISES:
                raise ValueError(f"there are {len(known)} of at most {MOST_OWN_EXERCISES} exercises; delete one first")
            private_folder(self.folder)
            write_whole(path, text, replace=replace)
        return path

    def delete(self, name: str) -> None:
        """Raises ValueError if there is none."""
        with self._lock:
            path = self.files().get(safe_name(name))
            if path is None:
                raise ValueError(f"there is no exercise {name} that was made here")
            path.unlink(missing_ok=True)

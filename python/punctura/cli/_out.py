"""What a verb writes: lines on standard error, and files, whose places are checked before a computation."""

import os
from collections.abc import Mapping
from pathlib import Path

import typer

from punctura.files.whole_file import target_problems


def notice(text: str) -> None:
    """Prints `punctura: TEXT` on standard error, so that standard output holds only the result."""
    typer.echo(f"punctura: {text}", err=True)


def check_apart(files: Mapping[str, Path | None]) -> None:
    """Says before a long computation that one file would overwrite another one. Raises BadParameter."""
    seen: dict[Path, str] = {}
    for option, path in files.items():
        if path is None:
            continue
        other = seen.setdefault(path.resolve(), option)
        if other != option:
            raise typer.BadParameter(f"{path} is the file of {other}, too; name another one", param_hint=option)


def check_place(path: Path | None, option: str) -> None:
    """Says before a long computation that a file cannot be written there. Raises BadParameter."""
    for problem in target_problems(path) if path else ():
        raise typer.BadParameter(f"{path}: {problem}", param_hint=option)


def check_folder(path: Path | None, option: str) -> None:
    """Says before a long computation that files cannot be written to a folder, which may not exist yet.

    Raises BadParameter.
    """
    if path is None:
        return
    near = path
    while not near.exists() and near != near.parent:
        near = near.parent
    if not near.is_dir():
        raise typer.BadParameter(f"{near} is a file, not a folder; name another folder", param_hint=option)
    if not os.access(near, os.W_OK | os.X_OK):
        raise typer.BadParameter(f"{path}: the folder {near} may not be written; choose another", param_hint=option)

"""Packages that Punctura needs only for some of its parts."""

import importlib
import re
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from punctura._core import PuncturaError


class MissingPackageError(PuncturaError, ModuleNotFoundError):
    """A package that a part of Punctura needs is not installed; the text says how to install it."""


def optional(package: str, extra: str, user: str) -> Any:
    """The imported `package`. Raises MissingPackageError.

    extra: that of pyproject.toml which has the package. user: the part of Punctura that needs it.
    """
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        if not f"{package}.".startswith(f"{error.name}."):  # a package that this one needs
            raise
        raise missing(package, extra, user) from None


def missing(package: str, extra: str, user: str) -> MissingPackageError:
    """The error for a package that is not there, or not in the right version.

    It names the packages, not punctura[extra]: no index has punctura, and its source would be compiled again.
    """
    name = package.partition(".")[0]
    command = [*_installer(), *(requirements(extra) or [name])]
    quoted = " ".join(part if re.fullmatch(r"[\w./:\\-]+", part) else f'"{part}"' for part in command)
    text = f"{user} needs the package {name}, of the extra {extra!r}. Install it: {quoted}"
    return MissingPackageError(text, name=name)


def _installer() -> list[str]:
    """The command that installs packages beside this Punctura. Environments of uv and pipx may have no pip."""
    if (Path(sys.prefix) / "pipx_metadata.json").exists():
        return ["pipx", "inject", Path(sys.prefix).name]
    if find_spec("pip"):
        return [sys.executable, "-m", "pip", "install"]
    return ["uv", "pip", "install", "--python", sys.executable]


def requirements(extra: str) -> list[str]:
    """What pip installs for an extra, such as "scipy>=1.11"; empty in a copy that pip did not install."""
    from importlib import metadata  # takes long

    found: list[str] = []
    try:
        lines = metadata.requires("punctura") or []
    except metadata.PackageNotFoundError:
        return found
    for line in lines:
        requirement, _, condition = (part.strip() for part in line.partition(";"))
        if re.search(rf"""\bextra == ["']{extra}["']""", condition):
            ours = re.fullmatch(r"punctura\[(.+)\]", requirement)
            for part in re.split(r",\s*", ours[1]) if ours else ():
                found += requirements(part)
            if not ours:
                found.append(requirement)
    return list(dict.fromkeys(found))

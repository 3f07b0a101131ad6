"""Packages that Punctura needs only for some of its parts."""

from __future__ import annotations

import importlib
from typing import Any

from punctura._core import PuncturaError


class MissingPackageError(PuncturaError, ModuleNotFoundError):
    """A package that a part of Punctura needs is not installed; the text says how to install it."""


def optional(package: str, extra: str, user: str) -> Any:
    """The imported `package`. Raises MissingPackageError.

    extra: the name in pip install 'punctura[extra]'. user: the part of Punctura that needs the package.
    """
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise MissingPackageError(
            f"{user} needs the package {package}. Install it: pip install 'punctura[{extra}]'", name=package
        ) from None

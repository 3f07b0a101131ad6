"""Packages that Punctura needs only for some of its parts."""

from __future__ import annotations

import importlib
from typing import Any


def optional(package: str, extra: str, user: str) -> Any:
    """The imported `package`. Raises ModuleNotFoundError that says how to install it.

    extra: the name in pip install 'punctura[extra]'. user: the part of Punctura that needs the package.
    """
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise ModuleNotFoundError(
            f"{user} needs the package {package}. Install it: pip install 'punctura[{extra}]'", name=package
        ) from None

"""The software versions behind the figures."""

from __future__ import annotations

import platform
from importlib.metadata import version

from punctura import __version__


def versions() -> dict[str, str]:
    """Name and version of the software that affects numbers and pictures."""
    return {
        "punctura": __version__,
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "matplotlib": version("matplotlib"),
        "system": f"{platform.system()} {platform.machine()}",
    }

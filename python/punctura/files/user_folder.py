"""The operating system's folders for what programs keep of their user."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Literal


def user_folder(kind: Literal["data", "state"]) -> Path:
    """Punctura's folder of this user. state: what may be lost, such as a log."""
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local") / "punctura"
    if sys.platform == "darwin":
        return Path.home() / "Library/Application Support/punctura"
    usual = {"data": ".local/share", "state": ".local/state"}[kind]  # XDG Base Directory Specification
    return Path(os.environ.get(f"XDG_{kind.upper()}_HOME", "").strip() or Path.home() / usual) / "punctura"

"""Identifies this build of Punctura and the machine it runs on."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from pathlib import Path

from punctura import _core


@cache
def build_id() -> str:
    """Version, compiler, and a digest of the compiled core. Builds with equal ids compute the same results."""
    digest = hashlib.sha256(Path(_core.__file__).read_bytes()).hexdigest()[:16]
    return f"punctura {_core.version()}; {_core.compiler()}; core {digest}"


def machine() -> str:
    """System and processor. A math library may select its code by them, which can change results."""
    return f"{platform.system()} {platform.release()} {platform.machine()} {'-'.join(platform.libc_ver())}".strip()

"""Which build of Punctura this is, and where it runs."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from pathlib import Path

from punctura import _core


@cache
def build_id() -> str:
    """Version, compiler, and a digest of the compiled core itself: two builds of one name compute the same."""
    digest = hashlib.sha256(Path(_core.__file__).read_bytes()).hexdigest()[:16]
    return f"punctura {_core.version()}; {_core.compiler()}; core {digest}"


def machine() -> str:
    """System and processor: a mathematical library may choose its code by them."""
    return f"{platform.system()} {platform.release()} {platform.machine()} {'-'.join(platform.libc_ver())}".strip()

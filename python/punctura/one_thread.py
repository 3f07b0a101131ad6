"""Linear algebra in one thread: for matrices as small as those of a fit, more threads cost far more than they save."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from punctura.extras import optional

_lock = threading.Lock()
_blocks: list[Any] = []  # the open ones; the first holds the limits, and the last one that ends restores them


@contextmanager
def one_thread(user: str) -> Iterator[None]:
    """Within its block, NumPy's and SciPy's linear algebra uses one thread, in the whole process.

    Blocks of several threads may overlap. user: the part of Punctura that needs SciPy. Raises ModuleNotFoundError
    without scipy or threadpoolctl.
    """
    optional("scipy", "identify", user)
    optional("scipy.linalg", "identify", user)  # only libraries that are loaded can be told
    pools = optional("threadpoolctl", "identify", user)
    with _lock:
        _blocks.append(None if _blocks else pools.threadpool_limits(1, "blas"))
    try:
        yield
    finally:
        with _lock:
            last = _blocks.pop()
            if not _blocks:
                last.restore_original_limits()

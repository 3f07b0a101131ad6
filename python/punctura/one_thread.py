"""Linear algebra in one thread: for matrices as small as those of a fit, more threads cost far more than they save."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Any

from punctura.extras import optional


def one_thread(user: str) -> AbstractContextManager[Any]:
    """Within its block, NumPy's and SciPy's linear algebra uses one thread, in the whole process.

    user: the part of Punctura that needs SciPy. Raises ModuleNotFoundError without scipy or threadpoolctl.
    """
    optional("scipy", "identify", user)
    optional("scipy.linalg", "identify", user)  # only libraries that are loaded can be told
    limits: AbstractContextManager[Any] = optional("threadpoolctl", "identify", user).threadpool_limits(1, "blas")
    return limits

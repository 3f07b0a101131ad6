"""Many runs at once: the same motion or the same hand through scenes that differ."""

from punctura._core import LineBatch
from punctura.batches.batch import batch
from punctura.batches.inputs import grid
from punctura.batches.result import BatchResult

__all__ = ["BatchResult", "LineBatch", "batch", "grid"]

"""The chunks of a study on a Dask cluster."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError
from typing import TYPE_CHECKING, Any, NamedTuple

from punctura import __version__
from punctura.extras import optional
from punctura.study.chunk import chunk_table
from punctura.study.design import Design
from punctura.study.folder import StudyError
from punctura.study.plan import Plan

if TYPE_CHECKING:
    import pyarrow as pa

_PATIENCE = "10s"


class Part(NamedTuple):
    """A chunk: its number, its first row, and its trials."""

    number: int
    begin: int
    trials: Design


def on_cluster(address: str, plan: Plan, parts: Sequence[Part]) -> Iterator[tuple[int, pa.Table]]:
    """Computes the chunks on the workers of a scheduler, and yields each with its number as soon as it is there.

    A worker computes as many chunks at once as it has threads. If it dies, Dask gives its chunks to others: each chunk
    arrives once. Raises StudyError if no scheduler answers, if a worker has another version of Punctura, or if
    workers die again and again.
    """
    distributed = optional("distributed", "dask", "punctura study --scheduler")
    try:
        client = distributed.Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as bad:
        raise StudyError(
            f"--scheduler {address}: no Dask scheduler answers ({bad}). Start one with dask scheduler, and workers "
            "with dask worker"
        ) from None
    with client:
        common = client.scatter(plan, broadcast=True)
        waiting = {client.submit(_compute, common, part, __version__, pure=False): part.number for part in parts}
        for future in distributed.as_completed(list(waiting), loop=client.loop):
            yield waiting.pop(future), _result(distributed, address, future)
            future.release()


def _result(distributed: Any, address: str, future: Any) -> pa.Table:
    try:
        table: pa.Table = future.result()
        return table
    except (distributed.KilledWorker, CancelledError) as bad:
        raise StudyError(
            f"--scheduler {address}: the scheduler was lost, or workers died again and again over one chunk ({bad}). "
            "Finished chunks are kept: give the same command again"
        ) from None


def _compute(plan: Plan, part: Part, version: str) -> pa.Table:
    """Runs on a worker."""
    if version != __version__:
        raise StudyError(f"a Dask worker has Punctura {__version__}, and this study needs {version}: install it there")
    return chunk_table(plan, part.trials, part.begin, threads=1)

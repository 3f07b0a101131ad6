"""The chunks of a study on a Dask cluster."""

from __future__ import annotations

import importlib.metadata
import pickle
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


def needed_package() -> Any:
    """The package distributed. Raises MissingPackageError."""
    return optional("distributed", "dask", "punctura study --scheduler")


def on_cluster(address: str, plan: Plan, parts: Sequence[Part]) -> Iterator[tuple[int, pa.Table]]:
    """Computes the chunks on the workers of a scheduler, and yields each with its number as soon as it is there.

    A worker computes as many chunks at once as it has threads. If it dies, Dask gives its chunks to others: each chunk
    arrives once. Raises StudyError if no scheduler answers, if it has no workers, if a worker has another version of
    Punctura or none, or if workers die again and again.
    """
    distributed = needed_package()
    try:
        client = distributed.Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as bad:
        raise StudyError(
            f"--scheduler {address}: no Dask scheduler answers ({bad}). Start one with dask scheduler, and workers "
            "with dask worker"
        ) from None
    with client:
        try:
            client.wait_for_workers(1, timeout=_PATIENCE)
        except TimeoutError:
            raise StudyError(f"--scheduler {address}: it has no workers. Start some with dask worker") from None
        check_workers(client, address)
        common = client.scatter(pickle.dumps(plan), broadcast=True)
        waiting = {
            client.submit(_compute, common, pickle.dumps(part), __version__, pure=False): part.number for part in parts
        }
        for future in distributed.as_completed(list(waiting), loop=client.loop):
            yield waiting.pop(future), _result(distributed, client, address, future)
            future.release()


def check_workers(client: Any, address: str) -> None:
    """Asks each worker for its version of Punctura. Raises StudyError if one has another version, or none.

    The question is a function of the standard library: a worker needs nothing of Punctura to answer it.
    """
    found = client.run(importlib.metadata.version, "punctura", on_error="return")
    for worker, version in sorted(found.items()):
        if version != __version__:
            has = f"Punctura {version}" if isinstance(version, str) else "no Punctura"
            raise StudyError(
                f"--scheduler {address}: the worker {worker} has {has}, and this study needs {__version__}: install "
                "it there, start the worker again, and give the same command again"
            )


def _result(distributed: Any, client: Any, address: str, future: Any) -> pa.Table:
    try:
        table: pa.Table = future.result()
        return table
    except (distributed.KilledWorker, CancelledError) as bad:
        raise StudyError(
            f"--scheduler {address}: the scheduler was lost, or workers died again and again over one chunk ({bad}). "
            "Finished chunks are kept: give the same command again"
        ) from None
    except Exception:  # a worker that came later and has another version can fail in any way
        check_workers(client, address)
        raise


def _compute(plan: bytes, part: bytes, version: str) -> pa.Table:
    """Runs on a worker. The plan and the part are unpickled only if the version is the same."""
    if version != __version__:
        raise StudyError(f"a Dask worker has Punctura {__version__}, and this study needs {version}: install it there")
    trials: Part = pickle.loads(part)
    return chunk_table(pickle.loads(plan), trials.trials, trials.begin, threads=1)

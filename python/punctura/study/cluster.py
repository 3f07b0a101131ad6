"""The chunks of a study on a Dask cluster."""

from __future__ import annotations

import asyncio
import importlib.metadata
import pickle
from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor
from queue import Empty, SimpleQueue
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

from punctura import __version__
from punctura.extras import optional
from punctura.study.design import Design, chunk_table
from punctura.study.folder import StudyError
from punctura.study.plan import Plan

if TYPE_CHECKING:
    import pyarrow as pa

_PATIENCE_S = 10  # for an answer
_WORKERLESS_S = 60  # a nanny starts a worker anew in some seconds
_KEPT = "Finished chunks are kept: give the same command again"


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

    A worker computes as many chunks at once as it has threads. The plan goes with each chunk: if a worker dies, Dask
    gives its chunks to others, also to those that come later, and each chunk arrives once. Raises StudyError if no
    scheduler answers, if it has no workers for long, if a worker has another version of Punctura or none, or if workers
    die again and again.
    """
    distributed = needed_package()
    with _connected(distributed, address) as client:
        try:
            client.wait_for_workers(1, timeout=_PATIENCE_S)
        except (asyncio.TimeoutError, TimeoutError):
            raise StudyError(f"--scheduler {address}: it has no workers. Start some with dask worker") from None
        check_workers(client, address)
        common = pickle.dumps(plan)
        waiting = {
            client.submit(_compute, common, pickle.dumps(part), __version__, pure=False): part.number for part in parts
        }
        finished: SimpleQueue[Any] = SimpleQueue()
        for future in waiting:
            future.add_done_callback(finished.put)
        alive = monotonic()
        while waiting:
            table = None
            try:
                future = finished.get(timeout=_PATIENCE_S)
                table = _result(distributed, client, address, future)
                if table is None:  # lost with its worker: another one computes it
                    future.add_done_callback(finished.put)
            except Empty:
                pass
            if table is not None:
                yield waiting.pop(future), table
                future.release()
            elif not _workers(client, address):
                if monotonic() - alive > _WORKERLESS_S:
                    raise StudyError(
                        f"--scheduler {address}: all workers are gone, and none came for {_WORKERLESS_S} s. Start "
                        f"some with dask worker. {_KEPT}"
                    )
                continue
            alive = monotonic()


def _connected(distributed: Any, address: str) -> Any:
    """A client of the scheduler. Raises StudyError within some seconds if nothing there speaks as a scheduler does."""

    async def greet() -> None:  # Client waits for ever for a program that accepts and says nothing
        options = distributed.Security().get_connection_args("client")
        comm = await asyncio.wait_for(
            distributed.core.connect(address, timeout=_PATIENCE_S / 2, **options), _PATIENCE_S
        )
        comm.abort()

    try:
        with ThreadPoolExecutor(1) as pool:  # a notebook has a loop in its own thread
            pool.submit(asyncio.run, greet()).result()
        return distributed.Client(address, timeout=_PATIENCE_S, set_as_default=False)
    except (asyncio.TimeoutError, TimeoutError):
        why = f"a program accepts there, and says nothing within {_PATIENCE_S} s"
    except (OSError, ValueError) as bad:
        why = str(bad)
    except Exception as bad:  # bytes that are not Dask's can fail in any way
        why = f"another program seems to answer there: {bad!r}"
    raise StudyError(
        f"--scheduler {address}: no Dask scheduler answers ({why}). Start one with dask scheduler, and workers with "
        "dask worker; give the address that the scheduler prints"
    )


def _workers(client: Any, address: str) -> int:
    """The number of workers. Raises StudyError for a scheduler that is gone or stands still."""
    try:
        return len(client.sync(client.scheduler.identity, callback_timeout=_PATIENCE_S)["workers"])
    except (OSError, asyncio.TimeoutError, TimeoutError) as bad:
        raise StudyError(f"--scheduler {address}: the scheduler no longer answers ({bad}). {_KEPT}") from None


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


def _result(distributed: Any, client: Any, address: str, future: Any) -> pa.Table | None:
    """The table of a chunk; None if it does not come from its worker."""
    try:
        table: pa.Table = future.result(timeout=_WORKERLESS_S)
        return table
    except (asyncio.TimeoutError, TimeoutError):
        return None
    except distributed.KilledWorker as bad:
        raise StudyError(
            f"--scheduler {address}: workers died again and again over one chunk ({bad}). {_KEPT}"
        ) from None
    except CancelledError as bad:
        raise StudyError(f"--scheduler {address}: the scheduler was lost or dropped a chunk ({bad}). {_KEPT}") from None
    except Exception:  # a worker that came later and has another version can fail in any way
        check_workers(client, address)
        raise


def _compute(plan: bytes, part: bytes, version: str) -> pa.Table:
    """Runs on a worker. The plan and the part are unpickled only if the version is the same."""
    if version != __version__:
        raise StudyError(f"a Dask worker has Punctura {__version__}, and this study needs {version}: install it there")
    trials: Part = pickle.loads(part)
    return chunk_table(pickle.loads(plan), trials.trials, trials.begin, threads=1)

"""The chunks of a study on a cluster, with stand-ins for the workers. integrations/dask has a real cluster."""

from __future__ import annotations

import asyncio
import importlib.metadata
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from punctura import __version__
from punctura.study import StudyError, load_plan
from punctura.study import cluster as module
from punctura.study.design import design
from studies import GRID, written


class Workers:
    """Answers as distributed.Client.run does: for each worker its result, or the exception as a value."""

    def __init__(self, **versions: object) -> None:
        self.versions = versions
        self.asked: list[Any] = []

    def run(self, *call: Any, on_error: str) -> dict[str, object]:
        self.asked.append((*call, on_error))
        return self.versions


def test_workers_with_the_same_version_pass() -> None:
    workers = Workers(one=__version__, two=__version__)
    module.check_workers(workers, "tcp://here")
    # A function of the standard library: a worker with any Punctura can unpickle it.
    assert workers.asked == [(importlib.metadata.version, "punctura", "return")]


@pytest.mark.parametrize(
    ("answer", "words"),
    [("0.0.9", "Punctura 0.0.9"), (importlib.metadata.PackageNotFoundError("punctura"), "no Punctura")],
)
def test_a_worker_with_another_version_or_none_is_named(answer: object, words: str) -> None:
    with pytest.raises(StudyError, match=f"tcp://here: the worker two has {words}, and this study needs {__version__}"):
        module.check_workers(Workers(one=__version__, two=answer), "tcp://here")


def test_nothing_is_unpickled_by_another_version() -> None:
    with pytest.raises(StudyError, match="this study needs 99"):
        module._compute(b"not a pickle", b"not a pickle", "99")


def test_a_chunk_that_fails_on_a_later_worker_tells_the_version() -> None:
    class Failed:
        def result(self, timeout: float) -> None:
            raise AttributeError("module has no attribute '_compute'")

    class Distributed:
        class KilledWorker(Exception): ...

    with pytest.raises(StudyError, match=r"late has Punctura 0\.0\.9"):
        module._result(Distributed, Workers(late="0.0.9"), "tcp://here", Failed())
    with pytest.raises(AttributeError):
        module._result(Distributed, Workers(late=__version__), "tcp://here", Failed())


class Future:
    """Has its result, or its exception, at once."""

    def __init__(self, call: tuple[Any, ...]) -> None:
        self.call = call

    def add_done_callback(self, put: Any) -> None:
        put(self)

    def result(self, timeout: float) -> Any:
        return self.call[0](*self.call[1:])

    def release(self) -> None: ...


class Lost(Future):
    """Never ends: its worker is gone."""

    def add_done_callback(self, put: Any) -> None: ...


class LostAtTheEnd(Future):
    """Has its result at once, and its worker is gone before it gives it."""

    puts = 0

    def add_done_callback(self, put: Any) -> None:
        self.puts += 1
        if self.puts == 1:
            put(self)

    def result(self, timeout: float) -> Any:
        raise TimeoutError


class Client(Workers):
    """A scheduler whose workers keep no data: what a chunk needs comes with it."""

    def __init__(self, kind: type[Future], present: int) -> None:
        super().__init__(one=__version__)
        self.kind, self.present, self.scheduler = kind, present, SimpleNamespace(identity=lambda: None)

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *error: object) -> None: ...

    def wait_for_workers(self, count: int, timeout: float) -> None: ...

    def submit(self, *call: Any, pure: bool) -> Future:
        return self.kind(call)

    def sync(self, call: Any, callback_timeout: float) -> dict[str, list[int]]:
        if self.present < 0:
            raise TimeoutError("timed out after 10 s")
        return {"workers": [0] * self.present}


def distributed_with(client: Client | None, connect: Any = None) -> Any:
    async def answers(*_: object, **__: object) -> Any:
        return SimpleNamespace(abort=lambda: None)

    return SimpleNamespace(
        Client=lambda *_, **__: client,
        Security=lambda: SimpleNamespace(get_connection_args=lambda role: {}),
        core=SimpleNamespace(connect=connect or answers),
        KilledWorker=KeyError,
    )


def on_cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, distributed: Any) -> list[tuple[int, Any]]:
    monkeypatch.setattr(module, "needed_package", lambda: distributed)
    monkeypatch.setattr(module, "_PATIENCE_S", 0.01)
    monkeypatch.setattr(module, "_WORKERLESS_S", 0.02)
    plan = load_plan(written(tmp_path, GRID))
    trials = design(plan)
    parts = [module.Part(number, 2 * number, trials.part(2 * number, 2 * number + 2)) for number in range(3)]
    return list(module.on_cluster("tcp://here", plan, parts))


def test_the_plan_goes_with_each_chunk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = on_cluster(tmp_path, monkeypatch, distributed_with(Client(Future, 1)))
    assert [(number, table["row"].to_pylist()) for number, table in found] == [(0, [0, 1]), (1, [2, 3]), (2, [4, 5])]


@pytest.mark.parametrize(
    ("present", "words"), [(0, r"all workers are gone, and none came"), (-1, "the scheduler no longer answers")]
)
@pytest.mark.parametrize("kind", [Lost, LostAtTheEnd])
def test_a_cluster_that_is_gone_ends_the_study(
    kind: type[Future], present: int, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(StudyError, match=rf"tcp://here: {words}.*Finished chunks are kept: give the same command"):
        on_cluster(tmp_path, monkeypatch, distributed_with(Client(kind, present)))


def test_what_is_no_scheduler_is_told_within_a_time_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async def silent(*_: object, **__: object) -> None:
        await asyncio.Event().wait()

    async def foreign(*_: object, **__: object) -> None:
        raise MemoryError("Unable to allocate 3.07 EiB")

    texts = {silent: r"accepts there, and says nothing within 0\.01 s", foreign: "seems to answer there: MemoryError"}
    for connect, words in texts.items():
        with pytest.raises(StudyError, match=rf"tcp://here: no Dask scheduler answers \(.*{words}.*give the address"):
            on_cluster(tmp_path, monkeypatch, distributed_with(None, connect))

"""The chunks of a study on a cluster, with stand-ins for the workers. integrations/dask has a real cluster."""

from __future__ import annotations

import importlib.metadata
from typing import Any

import pytest
from punctura import __version__
from punctura.study import StudyError
from punctura.study import cluster as module


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
        def result(self) -> None:
            raise AttributeError("module has no attribute '_compute'")

    class Distributed:
        class KilledWorker(Exception): ...

    with pytest.raises(StudyError, match=r"late has Punctura 0\.0\.9"):
        module._result(Distributed, Workers(late="0.0.9"), "tcp://here", Failed())
    with pytest.raises(AttributeError):
        module._result(Distributed, Workers(late=__version__), "tcp://here", Failed())

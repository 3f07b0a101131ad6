"""A studio whose worker waits for a file: "pause" takes the force away all the same."""

import threading
from contextlib import contextmanager

import pytest
from punctura.studio.shelf import Shelf

UNARMED = 0  # a snapshot's state


@contextmanager
def busy(session):
    """The worker waits until the block is over."""
    waits, over = threading.Event(), threading.Event()
    session.call(lambda: (waits.set(), over.wait(60)))
    assert waits.wait(60)
    try:
        yield
    finally:
        over.set()


def state(served):
    return served.session.run.loop.latest()["state"][0]


def test_pause_takes_the_force_away_while_the_worker_waits(served, page):
    page.wait(lambda: state(served) != UNARMED)
    with busy(served.session):
        page.send('{"id": 1001, "do": "pause"}')
        page.wait(lambda: state(served) == UNARMED)
    assert not page.status()["armed"]


def test_pause_takes_the_force_away_while_a_request_before_it_reads_a_file(served, page, monkeypatch):
    reading, over = threading.Event(), threading.Event()

    def open_slowly(_shelf, _name):
        reading.set()
        over.wait(60)
        raise ValueError("a slow disk")

    monkeypatch.setattr(Shelf, "open", open_slowly)
    page.wait(lambda: state(served) != UNARMED)
    try:
        page.send('{"id": 1001, "do": "play_motion", "recording": "slow"}')
        assert reading.wait(60)
        page.send('{"id": 1002, "do": "pause"}')
        page.wait(lambda: state(served) == UNARMED)
    finally:
        over.set()
    page.wait(lambda: [r["id"] for r in page.of("reply")] == [1001, 1002])


@pytest.mark.parametrize("before", ['"do": "arm"', '"do": "load", "scene": "k06-fig10"'])
def test_what_was_asked_for_before_a_pause_and_is_done_after_it_does_not_arm(served, page, before):
    page.wait(lambda: state(served) != UNARMED)
    with busy(served.session):
        page.send(f'{{"id": 1001, {before}}}')
        page.send('{"id": 1002, "do": "pause"}')
        page.wait(lambda: state(served) == UNARMED)
        seen = watch_arming(served.session)
    page.wait(lambda: len(page.of("reply")) == 2)
    assert all(reply["ok"] for reply in page.of("reply")) and seen == [False]
    assert state(served) == UNARMED and not page.status()["armed"]
    assert page.ask(do="arm")["ok"]
    page.wait(lambda: state(served) != UNARMED)


def watch_arming(session):
    """Whether the session was armed after each time that it was to be."""
    seen, arm = [], session.arm

    def watched():
        arm()
        seen.append(session.arming.armed)

    session.arm = watched
    return seen


@pytest.mark.parametrize(
    "begin", [{"do": "start_recording", "name": "r"}, {"do": "start_exercise", "exercise": "venipuncture"}]
)
def test_the_worker_looks_for_no_name_among_the_files(page, monkeypatch, begin):
    new_name, threads = Shelf.new_name, []

    def watched(*of):
        threads.append(threading.current_thread().name)
        return new_name(*of)

    monkeypatch.setattr(Shelf, "new_name", watched)
    assert page.ask(**begin)["ok"]
    assert threads and "punctura-studio" not in threads

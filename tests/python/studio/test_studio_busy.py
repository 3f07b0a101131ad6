"""While the studio's worker waits for a file, "pause" still switches the force off."""

import threading
from contextlib import contextmanager

import pytest
from punctura.studio import live, session
from punctura.studio.shelf import Shelf
from waiting import PATIENCE_S, wait_until

UNARMED = 0  # a snapshot's state


@contextmanager
def busy(session):
    """Makes the worker wait until the end of the block."""
    waits, over = threading.Event(), threading.Event()
    session.call(lambda: (waits.set(), over.wait(PATIENCE_S)))
    assert waits.wait(PATIENCE_S)
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

    def read_slowly(_shelf, _name, _act):
        reading.set()
        over.wait(PATIENCE_S)
        raise ValueError("a slow disk")

    monkeypatch.setattr(Shelf, "read", read_slowly)
    page.wait(lambda: state(served) != UNARMED)
    try:
        page.send('{"id": 1001, "do": "play_motion", "recording": "slow"}')
        assert reading.wait(PATIENCE_S)
        page.send('{"id": 1002, "do": "pause"}')
        page.wait(lambda: state(served) == UNARMED)
    finally:
        over.set()
    page.wait(lambda: [r["id"] for r in page.of("reply")] == [1001, 1002])


def test_a_pause_behind_a_full_queue_takes_the_force_away_at_once(served, page):
    page.wait(lambda: state(served) != UNARMED)
    many = range(1001, 1001 + 2 * live.MOST_ORDERS)
    with busy(served.session):
        for number in many:
            page.send(f'{{"id": {number}, "do": "arm"}}')
        page.send('{"id": 2001, "do": "pause"}')
        page.wait(lambda: state(served) == UNARMED)
        page.wait(lambda: any(reply["id"] == 2001 and reply["ok"] for reply in page.of("reply")))
    page.wait(lambda: len(page.of("reply")) == len(many) + 1)
    refused = sorted(reply["id"] for reply in page.of("reply") if not reply["ok"])
    assert refused == [*many[-len(refused) :]]
    assert len(many) - len(refused) - live.MOST_ORDERS in (0, 1)  # one may be out of the queue and being done
    assert "earlier requests of this page still wait" in next(r["text"] for r in page.of("reply") if not r["ok"])
    assert state(served) == UNARMED and not page.status()["armed"]


@pytest.mark.parametrize("before", ['"do": "arm"', '"do": "load", "scene": "k06-fig10"'])
def test_what_was_asked_for_before_a_pause_and_is_done_after_it_does_not_arm(served, page, before):
    page.wait(lambda: state(served) != UNARMED)
    with busy(served.session):
        page.send(f'{{"id": 1001, {before}}}')
        page.send('{"id": 1002, "do": "pause"}')
        page.wait(lambda: state(served) == UNARMED)
    page.wait(lambda: len(page.of("reply")) == 2)
    assert all(reply["ok"] for reply in page.of("reply"))
    page.wait(lambda: len(served.session.run.loop.latest()) and served.session.run.loop.latest()["tick"][0] > 10)
    assert state(served) == UNARMED and not page.status()["armed"]
    assert page.ask(do="arm")["ok"]
    page.wait(lambda: state(served) != UNARMED)


def test_after_a_stall_requests_are_served_between_parts_of_the_ticks_that_wait(served, page, monkeypatch):
    monkeypatch.setattr(session, "AT_ONCE", 100)
    loop, begun = served.session.run.loop, []
    turn = served.session.turn
    monkeypatch.setattr(served.session, "turn", lambda most=None: (begun.append(most), turn(most)))
    with busy(served.session):
        begun.clear()
        before = loop.ticks
        wait_until(lambda: loop.ticks > before + 1000)
        turns = served.session.call(lambda: len(begun))
    assert turns.result(60) <= 2
    wait_until(lambda: page.last.first_tick >= before + 1000)
    assert page.status()["lost"] == 0 and len(begun) > 8 and set(begun) == {106}  # four turns at 1600 Hz
    assert max(len(frame) for frame in page.frames[-8:]) <= 106

"""Faults in words, with their ticks as a file; defects in words, with their traceback in the log."""

import csv
import io

import numpy as np
import pytest
from punctura import defects
from punctura._core import Fault
from punctura.studio.health import fault_words
from waiting import wait_until


@pytest.fixture
def log(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr(defects, "_logged", {})  # else the same defect is logged once in a minute
    return defects.log_file()


def unforeseen(*_, **__):
    raise IndexError("unforeseen")


def test_requests_that_meet_a_defect_name_the_log_and_the_run_goes_on(served, page, monkeypatch, log):
    monkeypatch.setattr(served.session.shelf, "entries", unforeseen)
    status, text = page.get("/api/recordings")
    assert (
        status == 500 and text.decode().startswith("A defect, please report it: IndexError") and str(log) in str(text)
    )
    monkeypatch.setattr(served.session, "set_compare", unforeseen)
    answer = page.ask(do="compare", on=True)
    assert not answer["ok"] and str(log) in answer["text"]
    assert wait_until(lambda: log.exists() and log.read_text()).count("IndexError: unforeseen") >= 1
    assert page.ask(do="estimate", on=False)["ok"]


def test_a_worker_that_ends_by_a_defect_ends_the_run_with_it(served, page):
    served.session.jobs.post(unforeseen)
    wait_until(lambda: not served.session.running)
    assert isinstance(served.session.failure, IndexError)


def test_a_defect_outside_the_api_is_logged_and_its_request_gets_an_answer(served, page, monkeypatch, log):
    monkeypatch.setattr(served.guard, "_app", unforeseen)
    assert page.get("/")[0] == 500
    assert "IndexError: unforeseen" in wait_until(lambda: log.exists() and log.read_text())


@pytest.mark.parametrize("fault", [fault for fault in Fault if fault is not Fault.none])
def test_every_fault_says_in_sentences_what_happened_and_what_to_do(fault):
    for words in fault_words(fault):
        assert words[0].isupper() and words.endswith(".")


def test_the_ticks_before_a_fault_are_a_csv_file_that_stays_after_the_reset(page):
    assert page.get("/api/fault.csv") == (404, b"There was no fault.\n")
    page.wait(lambda: page.last.first_tick > 1000)
    assert page.ask(do="trip_fault")["ok"]
    fault = page.wait(lambda: next((f for f in page.of("fault") if f["reason"]), None))
    for _ in ("faulted", "after the reset"):
        status, text = page.get("/api/fault.csv")
        rows = list(csv.DictReader(io.StringIO(text.decode())))
        ticks = np.array([int(row["tick"]) for row in rows])
        assert status == 200 and len(rows) == fault["kept"] == 1000
        assert (np.diff(ticks) == 1).all() and ticks[-1] == fault["tick"]
        assert rows[-1]["fault"] == "non_finite_input" and {row["fault"] for row in rows[:-1]} == {"none"}
        assert page.ask(do="reset")["ok"]
    assert page.ask(do="load", scene="k06-fig10")["ok"]
    assert page.get("/api/fault.csv")[1] == text

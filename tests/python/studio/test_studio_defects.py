"""A defect in the studio is answered in words, and its traceback is in the log."""

import pytest
from punctura.defects import log_file
from waiting import wait_until


@pytest.fixture
def log(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return log_file()


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

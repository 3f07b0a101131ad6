"""A fault in the words of the page, and the ticks before it as a file."""

import csv
import io

import numpy as np
import pytest
from punctura._core import Fault
from punctura.studio.health import fault_words


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

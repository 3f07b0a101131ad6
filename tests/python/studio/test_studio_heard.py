"""How long the page that moves the hand was silent."""

import numpy as np
import pytest
from punctura.studio import hand as module
from punctura.studio.hand import Heard


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    return now


def test_each_tick_has_the_time_since_the_last_word(clock):
    heard = Heard()
    for clock[0] in (100.0, 100.1, 103.2):
        heard.hear(awake=True)
    times = np.array([0.9, 1.0, 1.05, 1.1, 2.0, 4.2])  # the last tick is that of the moment 103.2
    assert heard.age(times, 103.2) == pytest.approx([0.0, 0.0, 0.05, 0.0, 0.9, 0.0])


def test_a_page_that_never_says_that_it_is_awake_is_never_late(clock):
    heard = Heard()
    heard.hear()
    clock[0] = 200.0
    assert heard.age(np.array([0.0, 100.0]), 200.0) == pytest.approx([0.0, 0.0])
    heard.hear(awake=True)
    clock[0] = 200.5
    heard.hear()  # from now on a target is a word, too
    assert heard.age(np.array([1.0, 1.5]), 201.0) == pytest.approx([0.0, 0.5])
    heard.forget()
    assert heard.age(np.array([1.0, 9.0]), 208.5) == pytest.approx([0.0, 0.0])

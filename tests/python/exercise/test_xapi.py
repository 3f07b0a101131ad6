"""Results as xAPI statements: what a learning record store requires of each."""

import json
import re
import uuid

import pytest
from attempts import tried
from punctura.exercise.xapi import duration, statement, to_xapi

WAIT = (1.0, 0.0)
PASSED = tried("venipuncture", WAIT, (2.5, 20.0), (4.0, 27.8), (5.0, 27.8))
FAILED = tried("venipuncture", WAIT, (2.5, 20.0), (2.0, 33.0), (1.0, 33.0))
GIVEN_UP = tried("venipuncture", WAIT, (2.0, 16.0), (2.0, 16.0))


@pytest.mark.parametrize(("result", "verb"), [(PASSED, "passed"), (FAILED, "failed"), (GIVEN_UP, "attempted")])
def test_the_verb_says_how_the_attempt_ended(result, verb):
    record = statement(result)
    assert record["verb"] == {"id": f"http://adlnet.gov/expapi/verbs/{verb}", "display": {"en": verb}}
    assert record["result"].get("success") == {"passed": True, "failed": False, "attempted": None}[verb]
    assert record["result"]["completion"] == (verb != "attempted")


def test_a_statement_has_the_parts_that_the_format_asks_for():
    result = PASSED.model_copy(update={"person": "Ada", "group": "9b", "name": "a-result"})
    record = statement(result, "https://school.example/")
    assert uuid.UUID(record["id"]) and record["version"] == "1.0.3"
    account = {"homePage": "https://school.example", "name": "Ada"}
    assert record["actor"] == {"objectType": "Agent", "name": "Ada", "account": account}
    assert record["object"]["id"] == "https://school.example/exercises/venipuncture"
    assert record["context"]["team"]["account"]["name"] == "9b"
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00", record["timestamp"])
    assert record["result"]["score"] == {"scaled": 1.0, "raw": 7, "min": 0, "max": 7}
    assert record["result"]["duration"] == duration(result.metrics.total_time)
    forces = [value for key, value in record["result"]["extensions"].items() if key.endswith("/peak_force_N")]
    assert forces == [result.metrics.peak_force]


def test_the_same_result_has_the_same_id_and_another_one_has_another():
    names = [PASSED.model_copy(update={"name": name}) for name in ("a", "a", "b")]
    ids = [statement(result)["id"] for result in names]
    assert ids[0] == ids[1] != ids[2]


def test_a_person_without_a_name_is_anonymous_and_each_statement_is_a_line():
    lines = to_xapi([PASSED, FAILED]).splitlines()
    assert [json.loads(line)["actor"]["account"]["name"] for line in lines] == ["anonymous", "anonymous"]
    assert "team" not in json.loads(lines[0])["context"]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0, "PT0S"), (2.5, "PT2.5S"), (59.999, "PT1M0S"), (62.5, "PT1M2.5S"), (600, "PT10M0S"), (3.14159, "PT3.14S")],
)
def test_durations_are_iso_8601_in_hundredths_of_a_second(seconds, words):
    assert duration(seconds) == words

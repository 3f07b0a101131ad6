"""Writes results as xAPI statements (xAPI 1.0.3, ADL; the format is also that of IEEE 9274.1.1), one JSON a line."""

import json
import uuid
from collections.abc import Iterable
from typing import TypedDict

from punctura.exercise.result import Result

VERBS = "http://adlnet.gov/expapi/verbs/"
ACTIVITY = "http://adlnet.gov/expapi/activities/"
HOME = "https://punctura.example"  # an address that belongs to nobody (RFC 2606); a school names its own
NOBODY = "anonymous"


class Account(TypedDict):
    """A name in a school's system."""

    homePage: str
    name: str


class Agent(TypedDict):
    """A person or a group."""

    objectType: str
    name: str
    account: Account


class Verb(TypedDict):
    """What the person did."""

    id: str
    display: dict[str, str]  # by language


class Definition(TypedDict):
    """The kind and the title of an exercise."""

    type: str
    name: dict[str, str]  # by language


class Activity(TypedDict):
    """The exercise."""

    objectType: str
    id: str
    definition: Definition


class Score(TypedDict):
    """The goals that were met."""

    scaled: float
    raw: int
    min: int
    max: int


class Outcome(TypedDict, total=False):
    """The result. `success` is missing for an attempt, `score` without goals."""

    completion: bool
    duration: str
    response: str
    extensions: dict[str, float]
    success: bool
    score: Score


class Context(TypedDict, total=False):
    """The program, and the group if there is one."""

    platform: str
    team: Agent


class Statement(TypedDict):
    """An xAPI statement."""

    id: str
    actor: Agent
    verb: Verb
    object: Activity
    result: Outcome
    context: Context
    timestamp: str
    version: str


def to_xapi(results: Iterable[Result], home: str = HOME) -> str:
    """One statement a line. home: the address (IRL) of the system that knows the persons' account names."""
    return "".join(json.dumps(statement(result, home), ensure_ascii=False) + "\n" for result in results)


def statement(result: Result, home: str = HOME) -> Statement:
    """The statement of one attempt. The same result always has the same id."""
    home = home.rstrip("/")
    verb = _verb(result)
    exercise = f"{home}/exercises/{result.exercise}"
    person = result.person or NOBODY
    made: Statement = {
        "id": str(uuid.uuid5(uuid.NAMESPACE_URL, f"{home}/results/{result.name or result.date}")),
        "actor": {"objectType": "Agent", "name": person, "account": {"homePage": home, "name": person}},
        "verb": {"id": VERBS + verb, "display": {"en": verb}},
        "object": {
            "objectType": "Activity",
            "id": exercise,
            "definition": {"type": ACTIVITY + "simulation", "name": {"en": result.title}},
        },
        "result": _outcome(result, verb, home),
        "context": {"platform": f"Punctura {result.version}"},
        "timestamp": result.date,
        "version": "1.0.3",
    }
    if result.group:
        group: Agent = {
            "objectType": "Group",
            "name": result.group,
            "account": {"homePage": home, "name": result.group},
        }
        made["context"]["team"] = group
    return made


def _verb(result: Result) -> str:
    if result.passed:
        return "passed"
    return "failed" if any(goal.state == "missed" for goal in result.goals) else "attempted"


def _outcome(result: Result, verb: str, home: str) -> Outcome:
    met = sum(goal.state == "met" for goal in result.goals)
    m = result.metrics
    measures = {
        "entries": m.entries,
        "peak_force_N": m.peak_force,
        "largest_overshoot_m": max((one.distance for one in m.overshoot), default=None),
        "plunger_push_N": m.yields[-1].push if m.yields else None,
        "injected_m3": max((one.injected for one in m.yields), default=None),
        "longest_stay_s": m.longest_stay,
        "straightness": m.straightness,
        "lateral_deviation_m": m.lateral_deviation,
        "time_to_target_s": m.time_to_target,
    }
    outcome: Outcome = {
        "completion": verb != "attempted",
        "duration": duration(m.total_time),
        "response": " ".join(result.reasons),
        "extensions": {f"{home}/measures/{name}": value for name, value in measures.items() if value is not None},
    }
    if verb != "attempted":
        outcome["success"] = result.passed
    if result.goals:
        count = len(result.goals)
        outcome["score"] = {"scaled": round(met / count, 4), "raw": met, "min": 0, "max": count}
    return outcome


def duration(seconds: float) -> str:
    """An ISO 8601 duration in hundredths of a second, such as "PT1M2.5S"."""
    hundredths = round(seconds * 100)
    minutes, rest = divmod(hundredths, 6000)
    words = f"{rest / 100:.2f}".rstrip("0").rstrip(".")
    return f"PT{f'{minutes}M' if minutes else ''}{words}S"

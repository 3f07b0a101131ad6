"""What the analysis tells: of a level, of a participant, of all."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from pydantic import BaseModel

LEVEL = 0.95  # of all intervals
SHARES = ((1 - LEVEL) / 2, (1 + LEVEL) / 2)


class Estimate(NamedTuple):
    """A number and the ends of its 95 % interval. If the answers set no bound, an end is infinite. The number may be
    NaN then."""

    value: float
    low: float
    high: float


class Detection(BaseModel):
    """Answers at one level by the theory of signal detection."""

    level: float
    trials: int
    dprime: Estimate
    criterion: Estimate  # of yes, or of the first interval


class Person(BaseModel):
    """The result of one participant. Levels are in the unit of the protocol's variable."""

    participant: str
    number: int | None = None  # decides the order of the trials
    copy_of: str = ""  # the participant whose session this is, too; then it is not counted
    device: str = ""  # its model; empty for an observer
    device_simulated: bool = False  # then no hand felt a force
    version: str = ""  # of Punctura, with which the session began
    trials: int  # scored
    planned: int = 0  # scored trials of a whole session; 0 if it is whole
    threshold: Estimate | None = None  # the point of subjective equality, or the level of half the answers, or the
    # difference from the reference that is told with a probability half-way between guess and 1
    jnd: Estimate | None = None  # half the distance between 25 % and 75 %; for right answers the threshold itself
    weber: Estimate | None = None  # jnd / reference
    lapse: Estimate | None = None  # of the fit: share of answers by chance
    first: Estimate | None = None  # share of "first" if two intervals do not differ: the bias
    slope: Estimate | None = None  # of ratings: points for each unit of the variable
    reason: str = ""  # why there is no threshold
    detection: list[Detection] = []  # one for each level
    by_block: list[float | None] = []  # share of right answers or yes; mean rating or setting
    change: Estimate | None = None  # of by_block, from the first block to the last, at the same levels
    shift: Estimate | None = None  # the same of the share of "the comparison", which moves the threshold
    catch_trials: int = 0  # that were answered
    catch_counted: int = 0  # of them, how many with the answer that counts


class Analysis(BaseModel):
    """All participants, and their means with the interval of Student's t."""

    protocol: str  # its name
    unit: str  # of the levels
    felt: bool  # whether the function is one of the felt quantity, not of the planned level
    people: list[Person]  # one for each participant
    threshold: Estimate | None = None  # mean of the people
    jnd: Estimate | None = None  # mean of the people
    weber: Estimate | None = None  # mean of the people
    slope: Estimate | None = None  # mean of the people
    change: Estimate | None = None  # mean of the people
    shift: Estimate | None = None  # mean of the people
    reason: str = ""  # why there are no means


def no_mean(found: Analysis, titles: Mapping[str, str]) -> list[str]:
    """Why there is no mean of some numbers, or of all. titles: of the numbers."""
    if found.reason:
        return [f"No mean: {found.reason}."]
    known, lacking = [one for one in found.people if not one.reason], dict[str, list[str]]()
    for key, title in titles.items():
        of = {one.participant: getattr(one, key) for one in known}
        if key in Analysis.model_fields and getattr(found, key) is None and any(of.values()):
            names = [name for name, one in of.items() if one is None or not np.isfinite(one).all()]
            lacking.setdefault(f"{' and '.join(names)} {'have' if len(names) > 1 else 'has'}", []).append(title)
    return [
        f"No mean of {' and of '.join(some)}: it needs a number of everybody, and {who} none, or only a bound."
        for who, some in lacking.items()
    ]


def words(one: Estimate | None) -> str:
    """The number and its interval, or the bound that the answers set."""
    if one is None or not np.isfinite([one.low, one.high]).any():
        return "-"
    value, low, high = (f"{round(end, 12) + 0:.3g}" for end in one)
    if np.isfinite([one.low, one.high]).all():
        return f"{value} ({low} to {high})"
    bound = f"at least {low}" if np.isfinite(one.low) else f"at most {high}"
    return f"{value} ({bound})" if np.isfinite(one.value) else bound

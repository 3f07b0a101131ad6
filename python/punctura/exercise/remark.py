"""One sentence of the coach, and the numbers on which it rests."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Remark(_Part):
    about: str  # what it is about, such as "stop"; a fixed word, for programs
    text: str  # the sentence
    numbers: dict[str, Finite] = {}  # SI, with the unit in the name


class Coaching(_Part):
    """The coach's words about one attempt, the most important first. Empty if there is nothing to say."""

    good: list[Remark] = []  # what went well
    change: list[Remark] = []  # what to change next time

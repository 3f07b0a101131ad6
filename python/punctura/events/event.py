"""One event at a membrane."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]


class Event(BaseModel):
    """An event, in SI units. Forces are the model's, along the needle, before safety limits. Only a pop has forces."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    what: Literal["touch", "pop", "out"]  # tip enters; slanted face is through; tip has left
    membrane: int  # index in the scene, from 0
    name: str
    tick: int
    time: Finite  # s, of the tick
    depth: Finite  # m: along the needle while inside, else along the normal
    force_before: Finite = 0.0  # N, largest resistance before the pop
    force_after: Finite = 0.0  # N, resistance of the shaft alone after the pop
    drop: Finite = 0.0  # N, force_before - force_after

"""One thing that happened at a membrane."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]


class Event(BaseModel):
    """SI. Forces are the model's own, along the needle, before any safety limit; they are 0 but for a pop."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    what: Literal["touch", "pop", "out"]  # the tip comes in; its slanted face is through; it has left the membrane
    membrane: int  # its place in the scene, from 0
    name: str
    tick: int
    time: Finite  # s, of the tick
    depth: Finite  # m: along the needle while inside, else along the normal
    force_before: Finite = 0.0  # N, the largest resistance on the way to the pop
    force_after: Finite = 0.0  # N, the resistance of the shaft alone once the tip is through
    drop: Finite = 0.0  # N, force_before - force_after

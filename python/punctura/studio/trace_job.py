"""A job of the process that identifies traces."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, Field


class TraceJob(BaseModel):
    """A file in the present folder, and the words that the user gave for it."""

    task: Literal["look", "identify"]
    file: str
    columns: dict[str, str] = Field(default={})
    units: dict[str, str] = Field(default={})
    order: str = "recorded"
    diameter_mm: str = ""
    tip_angle_deg: str = ""
    membranes: str = "auto"

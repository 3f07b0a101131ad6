"""The numbers of one run."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from punctura._core import grazing_cosine
from punctura.compare.run import Array, Run
from punctura.events import crossing

OVERSHOOT_S = 0.3  # s after a pop in which the overshoot is measured, as in exercises
Finite = Annotated[float, Field(allow_inf_nan=False)]


class Pop(BaseModel):
    """A pop of a run. SI."""

    model_config = ConfigDict(frozen=True)

    membrane: int  # its number, from 0
    name: str  # of the membrane
    time: Finite  # s after the first contact
    drop: Finite  # N, of the model's resistance
    felt_drop: Finite | None  # N, of the felt force, between its largest and its smallest value around the pop
    overshoot: Finite | None  # m, farthest the bevel ran on past the membrane in the next OVERSHOOT_S


class Statistics(BaseModel):
    """The numbers of a run. SI."""

    model_config = ConfigDict(frozen=True)

    name: str  # of the run
    duration: Finite  # s, from the first contact to the last tick
    depth: Finite  # m, deepest place of the tip below the first surface
    peak: Finite  # N, largest model force
    felt_peak: Finite | None  # N, largest felt force; None without a device, as all felt numbers
    work: Finite  # J, of the hand against the model's force along the needle, from the first contact to the deepest
    # place of the insertion
    felt_work: Finite | None  # J, the same against the felt force
    thumb_peak: Finite | None  # N, largest model force of the thumb on the plunger; None without a syringe, as the next
    pressure_peak: Finite | None  # Pa, largest pressure in the syringe
    plunger_travel: Finite | None  # m, deepest place of the plunger
    drop: Finite | None  # N, the largest one at a pop; 0 without a pop; None with the force of a rival
    overshoot: Finite | None  # m, the largest one; None without a pop
    pops: list[Pop]  # by time


FELT_S = 0.05  # s on either side of a pop in which the drop of the felt force is measured


def statistics(run: Run) -> Statistics:
    """The numbers of a run."""
    touch = run.touch
    felt = bool(np.isfinite(run.felt).any())
    pops = _pops(run, float(run.time[touch]))
    inward = slice(touch, touch + int(np.nanargmax(run.depth[touch : run.out])) + 1)
    return Statistics(
        name=run.name,
        duration=float(run.time[-1] - run.time[touch]),
        depth=float(np.nanmax(run.depth)),
        peak=float(np.nanmax(run.model)),
        felt_peak=float(np.nanmax(run.felt)) if felt else None,
        work=float(np.nansum(run.model_along[inward] * run.travel[inward])),
        felt_work=float(np.nansum(run.felt_along[inward] * run.travel[inward])) if felt else None,
        thumb_peak=_largest(run.thumb),
        pressure_peak=_largest(run.pressure),
        plunger_travel=_largest(run.plunger),
        drop=max((pop.drop for pop in pops), default=0.0) if run.has_law else None,
        overshoot=max((pop.overshoot for pop in pops if pop.overshoot is not None), default=None),
        pops=pops,
    )


def _largest(values: Array) -> float | None:
    return float(np.nanmax(values)) if np.isfinite(values).any() else None


def _pops(run: Run, start: float) -> list[Pop]:
    found = []
    for event in run.events:
        if event.what != "pop":
            continue
        row = min(int(np.searchsorted(run.time, event.time)), len(run.time) - 1)
        around = np.abs(run.time - event.time) <= FELT_S
        found.append(
            Pop(
                membrane=event.membrane,
                name=event.name,
                time=event.time - start,
                drop=event.drop,
                felt_drop=_fall(run.felt[around], row - int(around.argmax())),
                overshoot=_overshoot(run, event.membrane, row),
            )
        )
    return found


def _fall(force: Array, row: int) -> float | None:
    """The largest value up to a row less the smallest value from it on; None without a value."""
    before, after = force[: row + 1], force[row:]
    known = np.isfinite(before).any() and np.isfinite(after).any()
    return float(np.nanmax(before) - np.nanmin(after)) if known else None


def _overshoot(run: Run, membrane: int, row: int) -> float | None:
    """How far the bevel ran on past a membrane after the pop, m; None for a membrane of a later scene."""
    if membrane >= len(run.scene.membranes):
        return None
    normal = np.asarray(run.scene.membranes[membrane].inward_normal)
    cosine = abs(float(run.axis[row] @ normal)) / float(np.linalg.norm(normal))
    through = crossing(run.scene, membrane, max(cosine, grazing_cosine)).through
    window = (run.time >= run.time[row]) & (run.time <= run.time[row] + OVERSHOOT_S)
    return max(0.0, float(np.nanmax(run.depths[window, membrane])) - through)

"""Converts a scene to what the page draws."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from punctura import Scene, _core
from punctura._core import obliquities
from punctura.studio.loaded import Loaded
from punctura.studio.run import Run
from punctura.studio.wire.common import LawCurve, MembraneView, SceneView, SyringeView
from punctura.studio.wire.messages import SceneMessage

__all__ = ["TURN", "Vector", "law_curves", "obliquities"]

TURN = math.radians(0.5)  # smaller changes of direction do not update the curves

Vector = npt.NDArray[np.float64]


def law_curves(scene: Scene, obliquities: npt.ArrayLike) -> list[LawCurve]:
    """One curve per membrane. obliquities (m,): rad."""
    angles = np.asarray(obliquities, float)
    return [LawCurve(**_core.law_curve(scene, i, float(angle))) for i, angle in enumerate(angles)]


def scene_view(
    loaded: Loaded, number: int, rate: float, force_scale: float, laws: list[LawCurve] | None = None
) -> SceneView:
    """number: index of the scene in this run. rate: the device's, Hz. force_scale: of this device. laws: by default
    those of an upright needle."""
    scene = loaded.scene
    if laws is None:
        laws = law_curves(scene, obliquities(scene, np.array(scene.membranes[0].inward_normal)))
    return SceneView(
        number=number,
        name=scene.name,
        diameter=scene.needle.diameter,
        tip_length=_core.tip_length(scene.needle),
        direction=scene.direction,
        solver=scene.servo.solver,
        rate=rate,
        force_scale=force_scale,
        membranes=membrane_views(scene),
        laws=laws,
        tables=loaded.tables(),
        lumen=list(scene.lumen or ()),
        syringe=_syringe_view(scene),
    )


def _syringe_view(scene: Scene) -> SyringeView | None:
    if scene.syringe is None:
        return None
    syringe = scene.syringe.syringe
    return SyringeView(bore=syringe.bore, volume=syringe.liquid + syringe.air)


def scene_message(run: Run, laws: list[LawCurve], new_run: bool) -> SceneMessage:
    """The scene of this run for the pages. new_run: the run begins; else its scene has changed."""
    view = scene_view(run.loaded, run.scenes, run.rate, run.loop.force_scale, laws)
    return SceneMessage(scene=view, new_run=new_run, run=run.number)


def membrane_views(scene: Scene) -> list[MembraneView]:
    """The places of the membranes."""
    return [
        MembraneView(
            name=placed.name,
            point=[float(x) for x in placed.point],
            inward_normal=(np.array(placed.inward_normal) / np.linalg.norm(placed.inward_normal)).tolist(),
            thickness=placed.membrane.thickness,
            look=placed.look,
            behind=placed.behind,
        )
        for placed in scene.membranes
    ]

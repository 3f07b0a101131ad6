"""Correct user code: type checkers accept all of it. test_user_program.py checks this file; nothing runs it."""

from pathlib import Path

import numpy as np
import punctura as pn
from punctura.exercise import Attempt, Result, ResultStore, load_exercise
from punctura.files.toml import Tables
from punctura.live import BackendState, RunLimits, enumerate_devices, load_limits, load_placement
from punctura.record import open_recording
from punctura.simulation import SimulationSummary
from punctura.studio.activity import Activity, ExerciseActivity, Outcome
from punctura.studio.wire.messages import Notice
from punctura.ticks import Ticks

needle = pn.Needle(diameter=1.08e-3, tip_angle=0.28)
scene: pn.Scene = pn.load_scene("k06-fig10")
firmer = scene.with_values({"membrane[0].stiffness": 800})
insertion = pn.Insertion(firmer)
force: object = insertion.step([0.0, 5e-3, 0.0], np.array([0.0, -1.0, 0.0]))
proxy = pn.Proxy1d(pn.ThinLaw(needle, scene.membranes[0].membrane), scene.coupling, 1e-3, solver="paper")
newtons: float = proxy.step(1e-3)
summary: SimulationSummary = pn.simulate(scene, "motion.csv", Path("forces.csv"))
ticks: pn.Ticks = pn.simulate(scene, np.linspace(0.0, 9e-3, 100), axis=[0, -1, 0])
peak = float(ticks.axial_force[:, 0].min()) + float(ticks[10:20]["lower"].max()) + len(proxy.run([0.0, 1e-3]).force)

states: list[BackendState] = enumerate_devices()
names: list[str] = [device for state in states if state["state"] == "available" for device in state["devices"]]
limits: RunLimits = load_limits("limits.toml").at_most(0.5)
scale: float = load_placement(Path("placement.toml")).scale

exercise = load_exercise("venipuncture")
result: Result = Attempt(exercise, scene).finish(person="Ada")
entries: int = ResultStore("results").save(result).metrics.entries
rows: int = open_recording("run.parquet").rows


class Quiet:
    what = "silence"

    def __init__(self) -> None:
        self.end_at: float | None = None

    def begin(self, scene: pn.Scene) -> None: ...

    def ticks(self, ticks: Ticks, now: float) -> list[Notice]:
        return []

    def scene_change(self) -> None: ...

    def stop(self) -> None: ...

    def finish(self) -> Outcome:
        return Outcome(Notice(text="over"))


activities: list[Activity] = [Quiet(), ExerciseActivity(exercise, "Ada", "run-1", ResultStore("results"))]
tables: Tables = {"name": "test"}

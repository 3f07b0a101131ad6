"""Runs FMUs of both versions in fmpy and compares their forces with those of the core.

python integrations/fmi/check.py REFERENCE FOLDER
"""

import sys
from collections.abc import Callable
from pathlib import Path

import fmpy
import numpy as np
import punctura as pn
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu
from punctura.fmu import export_fmu

INPUTS, FORCE, RAMP = [1, 2, 3, 4, 5, 6], [7, 8, 9], [10]


class Slave:
    """An FMU of either version, initialized."""

    def __init__(self, file: Path, ramp: bool = True) -> None:
        description = fmpy.read_model_description(file)
        kind = FMU2Slave if description.fmiVersion == "2.0" else FMU3Slave
        self.fmu = kind(
            guid=description.guid if kind is FMU2Slave else description.instantiationToken,
            unzipDirectory=fmpy.extract(file),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="needle",
        )
        self.two = kind is FMU2Slave
        self.fmu.instantiate()
        if self.two:
            self.fmu.setupExperiment(startTime=0.0)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.setBoolean(RAMP, [ramp])
        self.fmu.exitInitializationMode()

    def step(self, time: float, duration: float, inputs: np.ndarray) -> list[float]:
        (self.fmu.setReal if self.two else self.fmu.setFloat64)(INPUTS, list(inputs))
        self.fmu.doStep(time, duration)
        return list((self.fmu.getReal if self.two else self.fmu.getFloat64)(FORCE))

    def state(self) -> bytes:
        if self.two:
            return bytes(self.fmu.serializeFMUstate(self.fmu.getFMUstate()))
        return bytes(self.fmu.serializeFMUState(self.fmu.getFMUState()))

    def restore(self, state: bytes) -> None:
        if self.two:
            self.fmu.setFMUstate(self.fmu.deSerializeFMUstate(state))
        else:
            self.fmu.setFMUState(self.fmu.deserializeFMUState(state))


def refused(call: Callable[[], object], what: str) -> None:
    try:
        call()
    except Exception:
        return
    raise AssertionError(f"{what} was accepted")


def check(file: Path, rows: np.ndarray, rate: float) -> None:
    problems = validate_fmu(str(file))
    assert not problems, problems
    slave, n = Slave(file), len(rows)
    forces, kept = np.empty((n, 3)), b""
    for k in range(n):
        if k == n // 2:
            kept = slave.state()
        forces[k] = slave.step(k / rate, 1 / rate, rows[k, :6])
    assert forces.tobytes() == np.ascontiguousarray(rows[:, 6:]).tobytes(), "the forces differ from the core's"

    slave.restore(kept)
    for k in range(n // 2, n):
        assert list(rows[k, 6:]) == slave.step(k / rate, 1 / rate, rows[k, :6]), "after a restored state"

    # Steps of 10 ms, with 16 ticks in each: the last tick of each has the input itself.
    slave, held = Slave(file), Slave(file, ramp=False)
    insertion = pn.Insertion(pn.load_scene("k06-fig12"))
    before = rows[0, :6]
    for j in range(n // 16 - 1):
        at = rows[16 * j, :6]
        for i in range(1, 17):
            now = at if i == 16 else before + (at - before) * (i / 16)
            expected = insertion.step(now[:3], now[3:])
        assert list(expected) == slave.step(j * 0.01, 0.01, at), "sub-steps on a straight line"
        before = at
        assert np.isfinite(held.step(j * 0.01, 0.01, at)).all()

    damaged = [bytes([*kept[:i], kept[i] ^ 1, *kept[i + 1 :]]) for i in range(0, len(kept), 37)]
    for wrong in (kept[:-1], *damaged):
        refused(lambda wrong=wrong: slave.restore(wrong), "a state of another size, or a damaged one")
    end = (n // 16 - 1) * 0.01
    for wrong in (-1e-3, np.nan, 1e9):  # odd steps change nothing
        refused(lambda wrong=wrong: slave.step(end, wrong, rows[0, :6]), f"a step of {wrong} s")
    for time in (end - 0.01, end + 0.01):
        refused(lambda time=time: slave.step(time, 0.01, rows[0, :6]), f"a step at {time} s, which does not follow")
    slave.restore(kept)
    slave.step(n // 2 / rate, 0, rows[n // 2, :6])  # a step of 0 has no tick
    assert list(rows[n // 2, 6:]) == slave.step(n // 2 / rate, 1 / rate, rows[n // 2, :6]), "after a step of 0"
    print(f"{file.name}: {n} forces equal the core's bit for bit, also after a restored state and in sub-steps")


def simulate(file: Path, rows: np.ndarray, rate: float) -> None:
    """fmpy's own loop, as a newcomer uses it."""
    names = ["position.x", "position.y", "position.z", "axis.x", "axis.y", "axis.z"]
    signals = np.zeros(len(rows), dtype=[("time", float), *((name, float) for name in names)])
    signals["time"] = np.arange(len(rows)) / rate
    for k, name in enumerate(names):
        signals[name] = rows[:, k]
    result = fmpy.simulate_fmu(
        str(file), stop_time=1.0, output_interval=1 / rate, input=signals, output=["force.y"],
        start_values={"membrane[0].stiffness": 900.0},
    )  # fmt: skip
    firmer, core = np.nanmax(result["force.y"]), rows[: int(rate), 7].max()
    assert firmer > core, (firmer, core)
    print(f"{file.name}: simulate_fmu() with a firmer membrane gives {firmer:.3f} N instead of {core:.3f} N")


def main(reference: Path, folder: Path) -> None:
    rows = np.fromfile(reference / "motion.f64", "<f8").reshape(-1, 9)
    rate = pn.load_scene(reference / "scene.toml").servo.rate
    for version in (2, 3):
        file = export_fmu(reference / "scene.toml", folder / f"needle{version}.fmu", version=version)
        check(file, rows, rate)
        simulate(file, rows, rate)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))

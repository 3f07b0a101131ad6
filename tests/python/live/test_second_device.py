"""`punctura run --second-device`: two devices, two loops, one recording, and one safety state."""

import json
import math
import subprocess
import sys
import threading
import time
import types

import numpy as np
import punctura as pn
import pytest
from punctura._core import DeviceError, Fault, ForceLimits, GateLimits
from punctura.compare import compare, recorded_run
from punctura.compare.bundle import curves_table, ticks_table
from punctura.live import (
    DeviceInfo,
    FedDevice,
    RunLimits,
    SecondDevice,
    SecondDeviceError,
    SimulatedDevice,
    ThumbLoop,
    direction_of,
    run_live,
)
from punctura.live.session import Watched
from punctura.record import open_recording, replay
from punctura.simulation import Target
from punctura.studio.loaded import from_name
from punctura.studio.pump import Pump
from punctura.studio.run import NO_SYRINGE, Bench, Run, Settings
from waiting import LATE_ALLOWED, PATIENCE_S, wait_until

SCENE = pn.load_scene("epidural")
PATIENT = GateLimits(**LATE_ALLOWED)
ABOVE, DEEP = (0.0, 6e-3, 0.0), (0.0, -30e-3, 0.0)


class Library:
    """A maker's library that calls the device's tick 500 times a second, until it dies or ends."""

    def __init__(self, model, position):
        self.device = FedDevice(500, info=DeviceInfo(model=model, max_force=3.0))
        self.position, self.force = position, (math.nan,) * 3
        self.ended = False
        self._thread = threading.Thread(target=self._feed, daemon=True)
        self._thread.start()

    def _feed(self):
        while not self.ended:
            self.force = self.device.feed(self.position)
            time.sleep(2e-3)

    def die(self):
        self.ended = True
        self._thread.join()


@pytest.fixture
def pair():
    both = Library("the needle's", ABOVE), Library("the thumb's", (0.0, 0.0, 0.0))
    yield both
    for one in both:
        one.die()


def live(pair, act, **more):
    """Runs until it ends by itself. act: called once with the summary, when force is on."""
    needle, thumb = pair
    acted = []

    def watch(summary):
        if summary.state == "active" and not acted:
            acted.append(summary)
            act()

    loop = ThumbLoop(thumb.device, gate=PATIENT)
    summary = run_live(needle.device, SCENE, 60, PATIENT, watch=watch, thumb=loop, **more)
    assert acted, summary
    return summary, loop


def test_a_fault_of_the_second_device_ends_the_run_and_is_told(pair):
    needle, thumb = pair

    def act():
        thumb.position = (math.nan, 0.0, 0.0)

    summary, loop = live(pair, act)
    assert summary.fault.startswith("the device under the thumb has a fault of its own or sends nothing")
    assert "second device: the device reported a number that is not finite" in summary.fault
    assert loop.fault == Fault.non_finite_input
    wait_until(lambda: needle.force == thumb.force == (0.0, 0.0, 0.0))


@pytest.mark.parametrize("name", ["epidural", "k06-fig10"])
def test_a_fault_of_the_second_device_is_latched_by_the_needle_before_the_run_ends(name, monkeypatch):
    now = [0.0]
    monkeypatch.setattr("punctura.live.session.time", types.SimpleNamespace(monotonic=lambda: now[0]))
    needle, thumb = (FedDevice(500, info=DeviceInfo(model=model, max_force=3.0)) for model in ("needle", "thumb"))
    loop = ThumbLoop(thumb, gate=PATIENT)
    servo = pn._core.ServoLoop(needle, pn.load_scene(name), PATIENT, ForceLimits(), thumb=loop)
    watched = Watched(servo, loop)
    with servo:
        watched.begin()
        needle.feed(ABOVE)
        thumb.feed((math.nan, 0.0, 0.0))
        for _ in range(2):
            assert not watched.over() and servo.latest()["fault"][0] == Fault.none
        needle.feed(ABOVE)
        needle.feed(ABOVE)
        now[0] = 0.09
        assert watched.over()
        assert servo.latest()["fault"][0] == (Fault.thumb if name == "epidural" else Fault.none)


def test_a_needle_that_is_silent_does_not_hold_up_the_end_after_a_fault_of_the_second_device():
    needle, thumb = (FedDevice(500, info=DeviceInfo(model=model, max_force=3.0)) for model in ("needle", "thumb"))
    loop, acted = ThumbLoop(thumb, gate=PATIENT), []

    def watch(summary):
        if not acted:
            needle.feed(ABOVE)
            acted.append(thumb.feed((math.nan, 0.0, 0.0)))

    summary = run_live(needle, SCENE, 60, PATIENT, watch=watch, thumb=loop)
    assert summary.fault.startswith("the device under the thumb has a fault of its own or sends nothing")
    assert "ceased" not in summary.fault


@pytest.mark.parametrize("which", ["the device's ticks have ceased", "the device under the thumb has a fault"])
def test_a_library_that_dies_ends_the_run_of_both(pair, which):
    needle, thumb = pair
    dead = thumb if "thumb" in which else needle
    gate = PATIENT.replace(deadline=1.0)  # the needle's tick misses the thumb after 1 s; ticks have ceased after 5 s
    loop = ThumbLoop(thumb.device, gate=gate)
    acted = []

    def watch(summary):
        if summary.state == "active" and not acted:
            acted.append(dead.die())

    summary = run_live(needle.device, SCENE, 60, gate, watch=watch, thumb=loop)
    assert acted and summary.fault.startswith(which), summary.fault
    alive = thumb if dead is needle else needle
    wait_until(lambda: alive.force == (0.0, 0.0, 0.0))
    assert loop.force == 0


def test_two_simulated_devices_make_one_recording_that_replays_with_the_same_bits(tmp_path):
    path = tmp_path / "both.parquet"
    command = [sys.executable, "-m", "punctura", "run", "epidural", "--headless", "--device", "simulated"]
    more = ["--second-device", "simulated", "--duration", "3", "--json", "--record", str(path)]
    done = subprocess.run([*command, *more], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert result["second_device"] == "simulated: PHANTOM Omni, simulated" and result["thumb_peak_N"] > 0
    recording = open_recording(path)
    assert recording.info.header.second_device.device.backend == "simulated"
    assert recording.info.header.second_device.limits["max_force"] == 3.3
    ticks = recording.ticks()
    assert np.ptp(ticks.thumb) > 1e-3 and ticks.thumb_felt.min() < 0
    assert replay(path).identical
    run = recorded_run(path)
    found = compare([run, run])
    assert found.statistics[0].thumb_peak == -ticks.thumb_force.min() and found.summary()["thumb_peak"].deviation == 0
    assert found.statistics[0].pressure_peak == ticks.pressure.max()
    assert found.statistics[0].plunger_travel == ticks.plunger.max()
    assert {"thumb", "pressure", "plunger"} <= set(found.bands)
    columns = set(curves_table(found).column_names)
    assert {"thumb_force_N_mean", "pressure_Pa_01", "plunger_m_02"} <= columns
    assert {"pressure_Pa", "plunger_m"} <= set(ticks_table(run).column_names)


@pytest.mark.parametrize(
    ("scene", "second", "reason"),
    [
        ("k06-fig10", "simulated", "the scene K06 Fig. 10 has no [syringe]"),
        ("epidural", "nothing", "no device is called 'nothing'"),
        ("epidural", "replay:a.parquet", "a replay can only be the needle's device"),
    ],
)
def test_a_second_device_that_cannot_be_used_is_refused(scene, second, reason):
    needle = SimulatedDevice(Target(ABOVE))
    with pytest.raises(SecondDeviceError) as error:
        SecondDevice(second).open(pn.load_scene(scene), needle)
    assert reason in str(error.value) and isinstance(error.value, DeviceError)


@pytest.mark.parametrize("text", ["0,0,0", "1,2", "a,b,c", "nan,0,0", "inf,0,0", "", "1e200,1e200,1e200,0"])
def test_a_direction_that_is_none_is_refused(text):
    with pytest.raises(ValueError, match="must be three"):
        direction_of(text)
    assert direction_of(" 0, 0,2 ") == (0, 0, 2)


def test_the_limits_of_the_needle_hold_for_the_thumb_but_its_dead_man_button_does_not():
    limits = RunLimits(ForceLimits(max_force=0.4), {"dead_man": 1})
    device = FedDevice(500, info=DeviceInfo(model="a thumb", max_force=3.0))  # it has no button
    assert SecondDevice("mine").loop(device, limits).limits.max_force == 0.4


def test_the_studio_opens_the_second_device_for_each_run():
    loaded = from_name("epidural")
    bench = Bench(Settings("simulated", second=SecondDevice("simulated")), loaded.scene)
    assert bench.second_model == bench.device.info.model
    assert Bench(Settings("simulated"), loaded.scene).second_model == ""
    for number in range(2):
        run = Run(number, bench, loaded)
        run.start()
        wait_until(lambda run=run: run.thumb.ticks > 10 and len(run.loop.latest()) > 0)
        run.stop()
        assert run.thumb.fault == Fault.none and run.thumb.force == 0
    dry = Run(2, bench, from_name("k06-fig10"))
    assert NO_SYRINGE in dry.notes


def test_the_page_is_told_what_is_wrong_with_the_second_device(monkeypatch):
    thumb, result = Library("the thumb's", (0.0, 0.0, 0.0)), []
    monkeypatch.setattr("punctura.live.second.open_for", lambda *_: thumb.device)
    loaded = from_name("epidural")
    bench = Bench(Settings("simulated", limits=RunLimits(gate=LATE_ALLOWED), second=SecondDevice("mine")), loaded.scene)
    run = Run(0, bench, loaded)
    pump = Pump(run, types.SimpleNamespace(frame=lambda _: None, send=result.append))
    run.start()
    wait_until(lambda: run.thumb.ticks > 10)
    thumb.position = (math.nan, 0.0, 0.0)
    wait_until(lambda: run.fault == Fault.thumb)
    run.stop()
    thumb.die()
    pump.turn()
    (fault,) = [message for message in result if message.kind == "fault"]
    assert fault.fault == "thumb" and "under the thumb has a fault. The device reported a number" in fault.reason
    assert "cable" in fault.remedy

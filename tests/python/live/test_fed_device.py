"""A device that a loop in Python drives."""

import sys
import threading
import time

import numpy as np
import punctura as pn
import pytest
from punctura.live import (
    DeviceInfo,
    FedDevice,
    Pacer,
    ReplayDevice,
    ServoLoop,
    make_realtime,
    run_live,
)
from waiting import wait_until

SCENE = pn.load_scene("k06-fig10")
# Outside of tissue for the ramp, then through the membrane.
HEIGHT = np.concatenate([np.full(1600, 5e-3), np.linspace(5e-3, -6e-3, 2400)])
PATH = np.stack([np.zeros_like(HEIGHT), HEIGHT, np.zeros_like(HEIGHT)], axis=1)


def fed_forces(device, path):
    loop = ServoLoop(device, SCENE)
    loop.arm()
    loop.start()
    forces = [device.feed(p) for p in path]
    loop.stop()
    return np.array(forces), loop


def test_the_reply_to_a_reading_is_the_force_of_its_tick():
    forces, loop = fed_forces(FedDevice(1600, real_time=False), PATH)
    replayed = ReplayDevice(PATH, [0, -1, 0], 1600, real_time=False)
    other = ServoLoop(replayed, SCENE)
    listener = other.listen(len(PATH))
    other.arm()
    other.start()
    wait_until(lambda: replayed.finished)
    other.stop()
    assert np.array_equal(forces, listener.read()["force"])
    assert forces[:, 1].max() == pytest.approx(0.73, abs=0.01)
    assert loop.report()["ticks"] == loop.device.fed == len(PATH)


def test_all_of_a_reading_reaches_the_tick():
    device = FedDevice(1000, real_time=False)
    loop = ServoLoop(device, SCENE)
    loop.start()
    device.feed((0, 1e-3, 0))
    device.feed(np.array([1e-3, 2e-3, 3e-3]), axis=(0, 0, -1), buttons=3, motor_temperature=0.5)
    last = loop.latest()
    assert (last["sequence"][0], last["time"][0], last["buttons"][0]) == (1, 1e-3, 3)
    assert last["position"][0].tolist() == [1e-3, 2e-3, 3e-3] and last["axis"][0].tolist() == [0, 0, -1]
    assert last["motor_temperature"][0] == 0.5
    device.feed((0, 0, 0), healthy=False)
    assert loop.latest()["fault"][0] and "healthy = false" in device.trouble()


def test_what_the_device_says_of_itself_limits_the_force():
    info = DeviceInfo(model="mine", max_force=0.4, encoder_step=1e-5)
    forces, loop = fed_forces(FedDevice(1600, info=info, real_time=False), PATH)
    assert np.linalg.norm(forces, axis=1).max() == pytest.approx(0.4)
    assert (loop.device.info.backend, loop.device.info.model, loop.device.info.rate) == ("fed", "mine", 1600.0)
    assert np.isnan(loop.device.info.continuous_force)


def test_a_live_run_goes_on_beside_the_thread_that_feeds():
    device = FedDevice(1600, real_time=False)
    over, seen = threading.Event(), []

    class Enough(Exception):
        pass

    def feed():
        while not over.is_set():
            device.feed((0, 5e-3, 0))
            time.sleep(1e-4)

    feeder = threading.Thread(target=feed)
    feeder.start()

    def watch(summary):
        seen[:] = [summary]
        if summary.ticks > 100:
            raise Enough

    try:
        with pytest.raises(Enough):
            run_live(device, SCENE, 60, watch=watch)
    finally:
        over.set()
        feeder.join()
    assert [(summary.lost, summary.fault) for summary in seen] == [(0, "")]


def test_a_feeder_asks_for_real_time_priority_and_the_run_says_what_it_was_given():
    device, reports = FedDevice(1600), []

    def feed():
        reports.extend(device.make_realtime(processor=1 << 20))
        fed_forces(device, PATH[:10])

    feeder = threading.Thread(target=feed)
    feeder.start()
    feeder.join()
    assert reports and all("granted" in line for line in reports)
    assert any("processor 1048576: not granted" in line for line in reports), "asked for one that is not there"
    assert device.statements()[: len(reports)] == reports and "fed at" in device.statements()[-1]


def test_a_pacer_wakes_at_its_rate_and_never_early():
    begin = time.monotonic()
    pacer = Pacer(1000)
    left_out = sum(pacer.wait() for _ in range(20))
    assert time.monotonic() - begin >= 0.020 and left_out >= 0


def test_a_pacer_leaves_out_what_has_passed_and_lets_other_threads_run():
    pacer = Pacer(1000)
    time.sleep(0.02)
    assert pacer.wait() >= 18, "no burst after a pause"


def test_waiting_for_a_period_lets_other_threads_run():
    seen, waits = threading.Event(), []

    def wait():
        pacer = Pacer(100)
        while not seen.is_set() and len(waits) < 500:
            pacer.wait()
            waits.append("period")

    waiter = threading.Thread(target=wait)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(60)  # s: this thread runs only when the other one lets it
    try:
        waiter.start()
        seen.set()
        waiter.join()
    finally:
        sys.setswitchinterval(interval)
    assert len(waits) < 500, "no other thread ran during 500 waits"


def test_any_thread_may_ask_for_priority():
    reports = []
    asking = threading.Thread(target=lambda: reports.extend(make_realtime(priority=10)))
    asking.start()
    asking.join()
    assert reports and all("granted" in line for line in reports)


@pytest.mark.parametrize("made", [FedDevice, Pacer])
def test_a_rate_that_cannot_be_is_refused(made):
    with pytest.raises(pn.ConfigurationError) as error:
        made(0)
    assert error.value.problems[0].path == "device.rate"

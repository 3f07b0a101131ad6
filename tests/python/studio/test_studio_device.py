"""The studio on other devices: an Inverse3 with a simulated service, and a recorded motion."""

import threading
from contextlib import contextmanager

import inverse_service as fake
import pytest
from punctura import load_scene
from punctura._core import DeviceInfo, FedDevice, SimulatedDevice
from punctura.live import strokes_through
from punctura.record import open_recording
from punctura.studio.client import StudioClient
from punctura.studio.loaded import from_name
from punctura.studio.run import Settings
from punctura.studio.serve import StudioServer
from recorded import recorded
from waiting import PATIENCE_S


@pytest.fixture
def haply(monkeypatch, tmp_path):
    """The simulated service of an Inverse3, and the page of a studio on it."""
    service = fake.InverseService()
    with fake.Running(service) as url:
        monkeypatch.setenv("PUNCTURA_INVERSE_URL", url)
        server = StudioServer(from_name("k06-fig10"), Settings(device="haply"), page=tmp_path, folder=tmp_path / "kept")
        server.start()
        try:
            with StudioClient(server.address.url) as page:
                page.wait(lambda: page.last)
                yield service, server, page
        finally:
            server.stop()


def test_it_is_shown_as_what_it_is_and_its_hand_is_left_alone(haply):
    _, _, page = haply
    device = page.of("hello")[0]["device"]
    assert device["model"] == "Inverse3" and not device["simulated"]
    assert page.status()["hand"] == "device"
    page.target([0.0, 0.0, 0.0], [0.0, -1.0, 0.0])
    for request in ({"do": "strokes", "period": 2.0}, {"do": "trip_fault"}):
        answer = page.ask(**request)
        assert not answer["ok"] and "simulated" in answer["text"]


def test_it_stays_open_from_run_to_run_and_is_recorded(haply):
    _, server, page = haply
    assert page.ask(do="start_recording", name="arm")["ok"]
    page.wait(lambda: page.last.run == 1)  # no more ticks: a busy machine may be later than the 15 ms that end a run
    stopped = page.ask(do="stop_recording")
    assert stopped["ok"] and stopped["data"]["lost"] == 0, stopped
    page.wait(lambda: page.last.run == 2)
    assert open_recording(server.session.shelf.find("arm")).info.data["device"]["model"] == "Inverse3"
    assert page.ask(do="load", scene="venipuncture")["ok"]
    page.wait(lambda: page.last.run == 3 and page.last.membranes == 3)


def test_when_it_is_unplugged_the_page_is_told_why_and_the_studio_stays(haply):
    service, _, page = haply
    service.removed = True
    fault = page.wait(lambda: next((f for f in page.of("fault") if f["reason"]), None))
    assert fault["fault"] == "device" and fault["trouble"]
    assert service.idle.wait(PATIENCE_S)
    assert page.ask(do="pause")["ok"]
    refused = page.ask(do="load", scene="k06-fig10")
    assert not refused["ok"] and refused["text"]
    page.status()
    service.removed, before = False, page.last.run
    page.wait(lambda: page.ask(do="load", scene="k06-fig10")["ok"])
    page.wait(lambda: page.last.run > before)


@contextmanager
def playing(folder):
    """A studio on a recorded motion, and its page."""
    scene = load_scene("k06-fig10")
    device = SimulatedDevice(strokes_through(scene, 1, 0.5), real_time=False, ticks=1200)
    settings = Settings(device=f"replay:{recorded(folder / 'motion.parquet', device, scene, 1200)}")
    server = StudioServer(from_name("k06-fig10"), settings, page=folder, folder=folder / "kept")
    server.start()
    try:
        with StudioClient(server.address.url) as page:
            yield server, page
    finally:
        server.stop()


def test_a_recorded_motion_goes_round_and_its_hand_is_left_alone(tmp_path, monkeypatch):
    monkeypatch.setattr("punctura.studio.session.REST_S", 0.1)
    with playing(tmp_path) as (_, page):
        page.wait(lambda: page.last)
        assert "recorded" in page.of("hello")[0]["device"]["model"]
        assert not page.ask(do="strokes", period=2.0)["ok"]
        page.wait(lambda: page.last.run >= 2)


@contextmanager
def fed(folder, monkeypatch):
    """A studio on a device that a program feeds, its page, and a function that feeds one reading."""
    device = FedDevice(1600, info=DeviceInfo(model="a stylus"))
    monkeypatch.setattr("punctura.studio.run.open_for", lambda *_: device)
    server = StudioServer(from_name("k06-fig10"), Settings(), page=folder, folder=folder / "kept")
    server.start()
    try:
        with StudioClient(server.address.url) as page:
            page.wait(lambda: server.session.run.loop.running)
            yield server, page, lambda: device.feed((0.0, 5e-3, 0.0))
    finally:
        server.stop()


def told_silence(page):
    return [m for m in page.of("fault") if m["trouble"].startswith("the device's ticks have ceased")]


def test_ticks_that_cease_end_the_run_and_a_reset_begins_another(tmp_path, monkeypatch):
    asked = []
    with fed(tmp_path, monkeypatch) as (server, page, feed):
        loop = server.session.run.loop
        monkeypatch.setattr(FedDevice, "trouble", lambda device: asked.append(loop.running) or "The cable is out")
        feed()
        page.wait(lambda: told_silence(page))
        page.wait(lambda: any("switch it off. The cable is out" in m["trouble"] for m in page.of("fault")))
        assert asked == [False]  # whether the loop ran when the driver was asked what is wrong
        run = server.session.run.number
        assert page.ask(do="reset")["ok"]
        page.wait(lambda: feed() and page.last and page.last.run == run + 1)


def test_ticks_that_cease_end_the_run_while_the_worker_waits_for_a_file(tmp_path, monkeypatch):
    over = threading.Event()
    with fed(tmp_path, monkeypatch) as (server, page, feed):
        loop = server.session.run.loop
        server.session.call(lambda: over.wait(PATIENCE_S))
        feed()
        try:
            page.wait(lambda: not loop.running)
        finally:
            over.set()
        page.wait(lambda: told_silence(page))

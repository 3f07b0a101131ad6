"""A studio with the simulated device, its own folder and a minimal page."""

import os

import pytest
from punctura.live import RunLimits
from punctura.studio.client import StudioClient
from punctura.studio.loaded import from_name
from punctura.studio.run import Settings
from punctura.studio.serve import StudioServer
from waiting import LATE_ALLOWED, wait_until

os.environ["PUNCTURA_LAB_NICE"] = "0"  # other tests run at the same time; a computation must not wait for them


def serve(folder, scene="k06-fig12", settings=None, **more):
    page = folder / "page"
    (page / "assets").mkdir(parents=True, exist_ok=True)
    (page / "index.html").write_text("<!doctype html><title>page</title>")
    (page / "assets" / "a.js").write_text("1")
    settings = settings or Settings(limits=RunLimits(gate=LATE_ALLOWED))
    server = StudioServer(from_name(scene), settings, page=page, folder=folder / "kept", **more)
    server.start()
    return server


@pytest.fixture
def served(tmp_path):
    server = serve(tmp_path)
    yield server
    server.stop()


@pytest.fixture
def page(served):
    with StudioClient(served.address.url, keep_frames=True) as client:
        client.wait(lambda: client.of("scene") and client.last)
        yield client


@pytest.fixture(scope="module")
def guarded_by_all(tmp_path_factory):
    server = serve(tmp_path_factory.mktemp("studio"))
    yield server
    server.stop()


@pytest.fixture
def guarded(guarded_by_all):
    """A studio for many requests that must be rejected early, when nobody is connected any more."""
    wait_until_left(guarded_by_all)
    return guarded_by_all


def wait_until_left(server):
    """The server may notice late that a connection was closed at the other end."""
    connections = server.connections
    wait_until(lambda: not (server.hub.viewers or connections.known or connections.strangers))

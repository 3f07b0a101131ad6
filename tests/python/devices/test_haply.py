"""The Inverse3 back-end against a service whose WebSocket is the library websockets, not ours."""

import json

import inverse_service as fake
import pytest
from punctura import _core
from waiting import PATIENCE_S, wait_until


@pytest.mark.parametrize(("version", "takes"), [("3.5.2", "vector"), ("3.4.1", "values"), ("4.0.0", "vector")])
def test_each_generation_of_the_protocol_is_opened_with_its_own_key(version, takes):
    service = fake.InverseService(version, takes, strict=True)
    with fake.Running(service) as url:
        device = _core.open_device("haply", library=url)
        assert device.info.model == "Inverse3"
        assert device.info.serial == "049D"
        assert device.info.has_orientation
        assert 0 < device.info.rate <= 1600
        del device
        assert service.idle.wait(PATIENCE_S)
    first = service.messages[0]
    assert ("session" in first) == (takes == "vector")
    largest = max(
        abs(force[axis])
        for message in service.messages
        for arm in message["inverse3"]
        for force in arm.get("commands", {}).get("set_cursor_force", {}).values()
        for axis in "xyz"
    )
    assert largest <= 0.05  # nobody feels that it was opened


def test_after_a_stop_it_is_the_same_arm_again_or_none():
    service = fake.InverseService()
    with fake.Running(service) as url:
        device = fast_enough(url)
        loop = _core.ServoLoop(device, paper_scene())
        for _ in range(2):
            loop.start()
            wait_until(lambda: loop.report()["ticks"] > 0)
            assert "ms" in (device.trouble() or "ms")  # no trouble but a busy machine's, later than 15 ms
            loop.stop()
        service.id = "BEEF"
        with pytest.raises(_core.DeviceError, match="049D"):
            loop.start()
        assert service.idle.wait(PATIENCE_S)


def fast_enough(url):
    """The device. On a busy computer the service may answer so seldom at first that a loop refuses its rate."""
    return wait_until(
        lambda: next((it for it in [_core.open_device("haply", library=url)] if it.info.rate >= 100), None)
    )


def paper_scene():
    from punctura import Coupling, Membrane, Needle, PlacedMembrane, Scene

    wall = PlacedMembrane("wall", Membrane(570, 0.41, 0.2, 1e-3), [0, 0, 0], [0, -1, 0])
    return Scene("K06", Needle(1.08e-3, 0.28), Coupling(400, 1), [wall])


def test_the_simulated_service_keeps_to_the_contract_of_one_state_a_message():
    from websockets.sync.client import connect

    with fake.Running(fake.InverseService(persists=60)) as url, connect(url, compression=None) as client:
        assert "config" in json.loads(client.recv())["inverse3"][0]
        with pytest.raises(TimeoutError):
            client.recv(timeout=0.05)
        for _ in range(5):
            client.send("{}")
            assert "config" not in json.loads(client.recv())["inverse3"][0]
        with pytest.raises(TimeoutError):
            client.recv(timeout=0.05)

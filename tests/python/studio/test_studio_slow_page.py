"""A page that reads slowly, or not at all, for a while."""

import contextlib
import json
import socket

import pytest
from punctura.studio.limits import FRAMES_A_PING
from waiting import wait_until
from websockets.client import ClientProtocol
from websockets.frames import Opcode
from websockets.http11 import Response
from websockets.typing import Origin, Subprotocol
from websockets.uri import parse_uri


@pytest.fixture
def unanswering(served):
    """A connected page that answers no ping: its protocol and its socket."""
    address = served.address
    here = f"127.0.0.1:{address.port}"
    protocol = ClientProtocol(
        parse_uri(f"ws://{here}/ws"),
        origin=Origin(f"http://{here}"),
        subprotocols=[Subprotocol("punctura.v1"), Subprotocol(f"token.{address.token}")],
        max_size=None,
    )
    with socket.create_connection(("127.0.0.1", address.port)) as opened:
        protocol.send_request(protocol.connect())
        opened.sendall(b"".join(protocol.data_to_send()))
        yield protocol, opened


def received(protocol, opened):
    """What has arrived, without an answer."""
    opened.setblocking(False)
    with contextlib.suppress(BlockingIOError):
        while data := opened.recv(1 << 20):
            protocol.receive_data(data)
    opened.setblocking(True)
    return protocol.events_received()


def test_frames_wait_in_the_studio_for_a_page_that_reads_nothing_and_its_targets_are_taken(served, unanswering):
    protocol, opened = unanswering
    wait_until(lambda: any(viewer.dropped for viewer in served.hub.viewers.values()))
    events = received(protocol, opened)
    assert isinstance(events[0], Response) and events[0].status_code == 101
    kinds = [event.opcode for event in events[1:]]
    assert kinds.count(Opcode.BINARY) == 2 * FRAMES_A_PING and kinds.count(Opcode.PING) == 1

    place = [0.0, 0.004, 0.001]
    target = {"do": "target", "run": served.session.run.number, "position": place, "axis": [0.0, -1.0, 0.0]}
    protocol.data_to_send()  # the answer to the ping is never sent
    protocol.send_text(json.dumps(target).encode())
    opened.sendall(b"".join(protocol.data_to_send()))
    wait_until(lambda: list(served.session.hand.pose[0]) == place)


def test_frames_go_on_after_the_answer(served, unanswering):
    protocol, opened = unanswering
    wait_until(lambda: any(viewer.dropped for viewer in served.hub.viewers.values()))
    received(protocol, opened)
    opened.sendall(b"".join(protocol.data_to_send()))  # the answer
    wait_until(lambda: any(event.opcode is Opcode.BINARY for event in received(protocol, opened)))

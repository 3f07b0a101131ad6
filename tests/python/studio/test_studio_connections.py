"""The rules for the number of connections and for closing them, with a simulated clock."""

import re
from pathlib import Path

import pytest
from punctura.studio import connections as rules
from punctura.studio import limits
from punctura.studio.connections import Connections, open_file_limit, room
from punctura.studio.gate import Frames
from punctura.studio.limits import CLOSE_S, FILES_KEPT, FILES_WANTED, IDLE_S, STRANGER_S, UNREAD_S

DOCS = Path(__file__).parents[3] / "docs" / "studio-server.md"


class Transport:
    """A connection whose other end does nothing."""

    def __init__(self):
        self.written, self.aborted, self.closing = b"", False, False

    def get_extra_info(self, name):
        return {"peername": ("127.0.0.1", id(self))}[name]

    def set_write_buffer_limits(self, high):
        self.high = high

    def write(self, data):
        self.written += data

    def abort(self):
        self.aborted = self.closing = True

    def is_closing(self):
        return self.closing


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def connections(clock):
    return Connections(strangers=3, known=2, clock=clock)


def after(seconds, clock, connections):
    clock.now += seconds
    connections.sweep()


def test_a_connection_that_says_nothing_is_ended_and_told_why(clock, connections):
    connection = connections.add(Transport())
    after(STRANGER_S - 1, clock, connections)
    assert not connection.transport.aborted
    after(1, clock, connections)
    assert connection.transport.aborted and b" 408 " in connection.transport.written
    assert connection.transport.written.endswith(b".\n")


def test_requests_without_the_token_win_no_more_time(clock, connections):
    connection = connections.add(Transport())
    for _ in range(int(STRANGER_S)):
        after(1, clock, connections)
        with connection.serving():
            pass
    assert connection.transport.aborted


def test_the_oldest_stranger_makes_room_and_no_one_who_has_the_token(connections):
    known = connections.add(Transport())
    assert connections.admit(known)
    strangers = [connections.add(Transport()) for _ in range(5)]
    assert [c.transport.aborted for c in strangers] == [True, True, False, False, False]
    assert not known.transport.aborted and len(connections.strangers) == 3


def test_those_with_the_token_have_so_many_places_and_strangers_take_none(connections):
    for _ in range(5):
        connections.add(Transport())
    first, second, third = (connections.add(Transport()) for _ in range(3))
    assert connections.admit(first) and connections.admit(second) and connections.admit(first)
    assert not connections.admit(third)
    connections.remove(first)
    assert connections.admit(third)


def test_who_was_ended_takes_no_place_afterwards(connections):
    oldest, *_ = (connections.add(Transport()) for _ in range(4))
    assert oldest.transport.aborted and not connections.admit(oldest) and not connections.known


def test_a_later_connection_from_the_same_port_stays_known_by_its_address(connections, monkeypatch):
    monkeypatch.setattr(Transport, "get_extra_info", lambda self, name: ("127.0.0.1", 40000))
    earlier, later = (connections.add(Transport()) for _ in range(2))
    connections.remove(earlier)
    assert connections.of(("127.0.0.1", 40000)) is later
    connections.remove(later)
    assert connections.of(("127.0.0.1", 40000)) is None


def test_a_known_connection_stays_while_it_is_served_and_is_ended_when_idle(clock, connections):
    connection = connections.add(Transport())
    with connection.serving():
        connections.admit(connection)
        after(10 * IDLE_S, clock, connections)
    after(IDLE_S - 1, clock, connections)
    assert not connection.transport.aborted
    after(1, clock, connections)
    assert connection.transport.aborted and not connection.transport.written


def test_a_socket_whose_close_is_not_answered_is_ended_shortly(clock, connections):
    connection = connections.add(Transport())
    connection.socket = True
    with connection.serving():
        connections.admit(connection)
        after(1000, clock, connections)
    after(1, clock, connections)
    assert not connection.transport.aborted
    after(CLOSE_S, clock, connections)
    assert connection.transport.aborted


def test_a_transport_that_cannot_close_since_nobody_reads_is_ended(clock, connections):
    stranger, known = connections.add(Transport()), connections.add(Transport())
    connections.admit(known)
    stranger.transport.closing = known.transport.closing = True
    after(0, clock, connections)
    after(CLOSE_S, clock, connections)
    assert stranger.transport.aborted and not known.transport.aborted  # the end of a download may be on its way
    after(UNREAD_S, clock, connections)
    assert known.transport.aborted


def test_who_does_not_read_is_ended_and_who_reads_slowly_is_not(clock, connections):
    silent, slow = connections.add(Transport()), connections.add(Transport())
    for connection in (silent, slow):
        connections.admit(connection)
        connection.served = 1
        connection.writing(possible=False)
    for _ in range(3):
        after(UNREAD_S / 2, clock, connections)
        slow.writing(possible=True)
        slow.writing(possible=False)
    assert silent.transport.aborted and not slow.transport.aborted


@pytest.mark.parametrize("limit", [256, 512, 1024, 1e6, float("inf")])
def test_connections_leave_files_for_recordings(limit):
    strangers, known = room(limit)
    assert 2 * (strangers + known) + FILES_KEPT <= min(limit, FILES_WANTED)
    assert min(strangers, known) >= 16


@pytest.mark.parametrize(
    ("soft", "hard", "becomes"),
    [(256, 1 << 20, FILES_WANTED), (256, 512, 512), (4096, 4096, 4096), (256, -1, FILES_WANTED)],
)
def test_the_limit_of_open_files_is_raised_where_it_may_be(monkeypatch, soft, hard, becomes):
    class Resource:
        RLIMIT_NOFILE, RLIM_INFINITY = 7, -1
        limits = (soft, hard)

        def getrlimit(self, _):
            return self.limits

        def setrlimit(self, _, limits):
            assert limits[1] == hard
            self.limits = limits

    monkeypatch.setattr(rules, "resource", Resource())
    assert open_file_limit() == becomes == rules.resource.limits[0]


def test_a_limit_of_open_files_that_may_not_be_raised_stays(monkeypatch):
    class Resource:
        RLIMIT_NOFILE, RLIM_INFINITY = 7, -1

        def getrlimit(self, _):
            return 256, 4096

        def setrlimit(self, *_):
            raise ValueError("not allowed")

    monkeypatch.setattr(rules, "resource", Resource())
    assert open_file_limit() == 256


def frame(payload, masked=True, first=0x82):
    size = len(payload)
    extended = b"" if size < 126 else size.to_bytes(2 if size < 1 << 16 else 8, "big")
    short = size if size < 126 else 126 if size < 1 << 16 else 127
    return bytes([first, short | (0x80 if masked else 0)]) + extended + (bytes(4) if masked else b"") + payload


@pytest.mark.parametrize("masked", [True, False])
@pytest.mark.parametrize("piece", [1, 2, 3, 7, 1 << 20])
def test_frames_are_found_in_any_pieces_of_the_stream(piece, masked):
    parts = [frame(b"\x82" * size, masked) for size in (0, 1, 125, 126, 0xFFFF, 0x10000, 0)]
    data, ends = b"".join(parts), [sum(map(len, parts[:n])) for n in range(len(parts))]
    for most in range(len(parts)):
        left, found, read = iter([True] * most + [False]), Frames(), 0
        for at in range(0, len(data), piece):
            part = data[at : at + piece]
            allowed = found.allowed(part, lambda left=left: next(left))
            read += allowed
            if allowed < len(part):
                break
        assert read == ends[most]


def test_every_limit_stands_in_the_docs():
    table = DOCS.read_text(encoding="utf-8").split("## Limits")[1].split("## Measured")[0]
    names = {name: value for name, value in vars(limits).items() if name.isupper() and name != "SWEEP_S"}
    missing = [name for name, value in names.items() if not re.search(rf"(?<![\d,]){value:,.0f}(?![\d,])", table)]
    assert len(names) > 20 and not missing

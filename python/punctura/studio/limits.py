"""Limits for connections, requests and unread data: see docs/studio-server.md. A page stays far below them."""

import time
from collections.abc import Callable

# Sizes, bytes.
MOST_BODY = 64_000  # of an HTTP request
MOST_TRACE = 32_000_000  # of an HTTP request with the file of a trace
MOST_TEXT = 64_000  # of a request on the socket
MOST_OWN_EXERCISES = 100  # files of exercises that were made in the page
MOST_SCENE_TEXT = 256_000  # of a request that carries a file: a scene has at most 200 000 characters
MOST_BUFFERED = 65_536  # sent by the studio and not yet taken by the other end's kernel; above it, the sender waits
MOST_PONGS = 4_096  # the same; above it, a ping gets no answer

# Rates: so many a second, and so many at once.
REQUESTS_A_SECOND, REQUESTS_AT_ONCE = 400, 1200  # frames of any kind from one page: targets at 240 per second
HTTP_A_SECOND, HTTP_AT_ONCE = 200, 600  # with the token
FREE_A_SECOND, FREE_AT_ONCE = 200, 600  # requests for public files without the token
# Refusals with a reason. Above this, a refusal says only that there are too many requests.
REFUSED_A_SECOND, REFUSED_AT_ONCE = 100, 300

# Counts.
MOST_VIEWERS = 32  # pages
MOST_TICK_BYTES = 16_000_000  # that wait for one page; then all are dropped, which leaves one gap
MOST_JOINED = 1_000_000  # bytes of ticks in one message; a longer one would take too long on a slow link
MOST_ON_WAY = 2  # messages with ticks to a page that says when it has taken one
MOST_MESSAGES = 8_000_000  # bytes of messages that wait for one page; they are never dropped, so the page is closed
MOST_KNOWN = 128  # connections with the token: each page has one socket and at most six others
MOST_STRANGERS = 64  # connections without the token: if there are more, the oldest is closed
ACCEPTED_AT_ONCE = 8  # connections accepted before the server turns to other work
LISTEN_QUEUE = 1024  # connections that the system holds until they are accepted
MOST_EXPORTS = 4  # downloads made while they are sent: each keeps a core busy while it is read
FILES_WANTED = 1024  # open files; no more, since a maker's driver that calls select() cannot have a number above it
FILES_KEPT = 192  # of these, for the device, recordings, exports and what Python and its libraries open

# Times, seconds.
STRANGER_S = 10.0  # for a whole request with the token to arrive; then the connection is ended
IDLE_S = 15.0  # between two requests of a connection that has shown the token
CLOSE_S = 2.0  # for the other end to answer a close, and to read what was sent before it
FILE_S = 60.0  # for a whole file of a measured trace to arrive
UNREAD_S = 30.0  # for the other end to continue reading, when MOST_BUFFERED is reached
SWEEP_S = 0.5  # between two checks of all connections


class Bucket:
    """A token bucket: a burst, then a rate per second."""

    def __init__(self, rate: float, most: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._most, self._clock = rate, most, clock
        self._left, self._at = most, clock()

    def take(self) -> bool:
        """Takes one; False if there are too many."""
        now = self._clock()
        self._left = min(self._most, self._left + (now - self._at) * self._rate)
        self._at = now
        if self._left < 1:
            return False
        self._left -= 1
        return True

    def fill(self) -> None:
        """Fills the bucket."""
        self._left = self._most

    def empty(self) -> None:
        """Empties the bucket."""
        self._left, self._at = 0.0, self._clock()

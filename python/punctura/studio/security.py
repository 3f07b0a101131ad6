"""Access to the studio: only from this computer, from the studio's own page, and with the token of this run.

ASGI middleware around everything else. A refusal has a status and a sentence. See docs/studio-server.md.
"""

import ipaddress
import secrets
from collections.abc import Callable, Iterable
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from punctura.studio.connections import Connection, Connections
from punctura.studio.limits import (
    FREE_A_SECOND,
    FREE_AT_ONCE,
    HTTP_A_SECOND,
    HTTP_AT_ONCE,
    MOST_BODY,
    MOST_TRACE,
    REFUSED_A_SECOND,
    REFUSED_AT_ONCE,
    Bucket,
)

PROTOCOL = "punctura.v1"
TOKEN_PROTOCOL = "token."
FREE = ("/assets/", "/figures/")  # public folders
TOKEN_PART = "token="  # of the path of an asset: /assets/token=TOKEN/page.js
FREE_FILES = ("/", "/icon.svg", "/favicon.ico")  # a reload of the page has no token in its address
WITH_TOKEN = "punctura.with_token"  # in the scope: whether the request has the token
FILES = ("/api/lab/file", "/api/lab/identify")  # a POST may have a file of MOST_TRACE as its body
NO_TOKEN = "This needs the token of this run: open the address that the studio printed."

_COMMON = {
    "cache-control": "no-store",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "x-frame-options": "DENY",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
_PAGE_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
    "connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
# The page of `punctura reproduce` contains its style and its drawings, and no script.
_FIGURES_POLICY = (
    "default-src 'none'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)


class Refused(Exception):
    """A request that is refused."""

    def __init__(self, status: int, sentence: str) -> None:
        super().__init__(sentence)
        self.status, self.sentence = status, sentence


class TooLarge(Exception):
    """A body that exceeded its limit while it was read."""

    def __init__(self) -> None:
        super().__init__("The request is too large.")


class Guard:
    """ASGI middleware. port: the server's; token: of this run; report: gets what the application did not foresee."""

    def __init__(
        self, app: ASGIApp, port: int, token: str, connections: Connections, report: Callable[[Exception], object]
    ) -> None:
        self._app, self._token, self._connections, self._report = app, token, connections, report
        names = ["127.0.0.1", "localhost", "[::1]"]
        self._hosts = {f"{name}:{port}" for name in names} | (set(names) if port == 80 else set())
        self.bucket = Bucket(HTTP_A_SECOND, HTTP_AT_ONCE)
        self.free = Bucket(FREE_A_SECOND, FREE_AT_ONCE)
        self.refusals = Bucket(REFUSED_A_SECOND, REFUSED_AT_ONCE)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        connection = self._connections.of(scope.get("client"))
        if connection is None:
            await _refuse(scope, send, Refused(403, "The studio serves this computer only."))
            return
        with connection.serving():
            try:
                self._check(scope, Headers(scope=scope), connection)
                serve = self._app if scope["type"] == "websocket" else self._serve
                await serve(scope, receive, send)
            except Refused as no:
                await _refuse(scope, send, no)
            except Exception as error:
                if not connection.transport.is_closing():  # else the other end has gone, or sent what is no HTTP
                    self._report(error)
                raise

    def _check(self, scope: Scope, headers: Headers, connection: Connection) -> None:
        """Raises Refused. Requests without the token do not use up the limits of requests with it."""
        try:
            with_token = self._let_in(scope, headers)
        except Refused:
            if self.refusals.take():
                raise
            raise Refused(429, "Too many requests without the token; wait a second.") from None
        scope[WITH_TOKEN] = with_token
        if not with_token:
            if not self.free.take():
                raise Refused(429, "Too many requests without the token; wait a second.")
            return
        if not self._connections.admit(connection):
            raise Refused(503, "Too many connections are open with this token; close some pages.")
        if not self.bucket.take():
            raise Refused(429, "Too many requests; wait a second.")

    def _let_in(self, scope: Scope, headers: Headers) -> bool:
        """Whether the request has the token. Raises Refused if it is not allowed."""
        client = scope.get("client")
        if not client or not _is_loopback(client[0]):
            raise Refused(403, "The studio serves this computer only.")
        if len(headers.getlist("host")) != 1 or headers["host"].lower() not in self._hosts:
            raise Refused(421, "The studio does not go by this name; use the address that it printed.")
        origins = headers.getlist("origin")
        own = f"http://{headers['host'].lower()}"
        if any(origin.lower() != own for origin in origins) or len(origins) > 1:
            raise Refused(403, "Only the studio's own page may ask.")
        if scope["type"] == "websocket":
            if not origins:
                raise Refused(403, "A socket needs the studio's own page behind it.")
            if not self._is_token(_socket_tokens(scope)):
                raise Refused(401, NO_TOKEN)
            return True
        if scope["method"] not in ("GET", "HEAD", "DELETE") and not _sends_a_file(scope):
            raise Refused(405, "The studio knows GET, HEAD and DELETE, and POST for the file of a trace.")
        if self._is_token(_tokens(scope, headers)):
            return True
        path = scope["path"]
        if path.startswith(FREE) or path in FREE_FILES:
            return False
        raise Refused(401, NO_TOKEN)

    def _is_token(self, candidates: Iterable[str]) -> bool:
        return any(secrets.compare_digest(c.encode(), self._token.encode()) for c in candidates)

    async def _serve(self, scope: Scope, receive: Receive, send: Send) -> None:
        size = 0
        most = MOST_TRACE if _sends_a_file(scope) else MOST_BODY
        begun = False
        rest = _has_body(scope)  # of the body, that was not read yet

        async def counted() -> Message:
            nonlocal size, rest
            message = await receive()
            rest = rest and message.get("more_body", False)
            size += len(message.get("body", b""))
            if size > most:
                raise TooLarge
            return message

        async def dressed(message: Message) -> None:
            nonlocal begun
            if message["type"] == "http.response.start":
                begun = True
                _add_headers(message, scope["path"])
                if rest:  # else the server would read and drop it, however long it is
                    MutableHeaders(scope=message)["connection"] = "close"
            await send(message)

        try:
            length = Headers(scope=scope).get("content-length", "0")
            if not length.isdigit() or int(length[:20]) > most:
                raise TooLarge
            await self._app(scope, counted, dressed)
        except TooLarge:
            if not begun:
                await _refuse(scope, send, Refused(413, str(TooLarge())))


def _sends_a_file(scope: Scope) -> bool:
    return scope["method"] == "POST" and scope["path"] in FILES


def _has_body(scope: Scope) -> bool:
    headers = Headers(scope=scope)
    return "transfer-encoding" in headers or headers.get("content-length", "0") != "0"


def _socket_tokens(scope: Scope) -> list[str]:
    """The tokens in a websocket's subprotocols."""
    return [p.removeprefix(TOKEN_PROTOCOL) for p in scope.get("subprotocols", []) if p.startswith(TOKEN_PROTOCOL)]


def _tokens(scope: Scope, headers: Headers) -> list[str]:
    """From the header, or from the URL, as for links and downloads."""
    found = [part.removeprefix(TOKEN_PART) for part in scope["path"].split("/") if part.startswith(TOKEN_PART)]
    scheme, _, value = headers.get("authorization", "").partition(" ")
    if scheme.lower() == "bearer":
        found.append(value.strip())
    try:
        query = parse_qs(scope.get("query_string", b"").decode("latin-1"), max_num_fields=20)
    except ValueError:
        query = {}
    return found + query.get("token", [])


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def _add_headers(message: Message, path: str) -> None:
    headers = MutableHeaders(scope=message)
    for name, value in _COMMON.items():
        headers[name] = value
    headers["content-security-policy"] = _FIGURES_POLICY if path.startswith("/figures/") else _PAGE_POLICY


async def _refuse(scope: Scope, send: Send, no: Refused) -> None:
    body = (no.sentence + "\n").encode()
    kind = "http.response"
    if scope["type"] == "websocket":
        if "websocket.http.response" not in scope.get("extensions", {}):
            await send({"type": "websocket.close", "code": 1008, "reason": no.sentence})
            return
        kind = "websocket.http.response"
    start: Message = {
        "type": f"{kind}.start",
        "status": no.status,
        "headers": [
            (b"content-type", b"text/plain; charset=utf-8"),
            (b"content-length", str(len(body)).encode()),
            (b"connection", b"close"),
        ],
    }
    _add_headers(start, "")
    await send(start)
    await send({"type": f"{kind}.body", "body": body})

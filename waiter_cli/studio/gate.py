"""Checks who speaks to the studio before anything else, adds headers to all answers. Class `Gate`.

A page of another site can make a browser send requests here, and a name of its own can be made to
lead here.  So ``Host`` must be this machine and port, ``Origin`` this page on every POST and on the
WebSocket, a POST must carry JSON of at most `MAX_BODY` bytes, and all but the shell needs the cookie for
which the page trades the token of its address.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Awaitable, Callable, MutableMapping
from http.cookies import CookieError, SimpleCookie
from typing import Any

__all__ = ["MAX_BODY", "Gate", "Keys", "TokenRefused"]

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

MAX_BODY = 1 << 20
"""The longest body of a POST, in bytes."""
OPEN_PATHS = ("/", "/healthz", "/start.js", "/icon.svg", "/token")
"""What needs no cookie: the shell, and what trades the token for one."""
HEADERS = (
    (
        b"content-security-policy",
        b"default-src 'self'; img-src 'self' blob:; object-src 'none'; "
        b"base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cache-control", b"no-store"),
)


COOKIE_SECONDS = 24 * 60 * 60
"""So long a browser keeps the cookie since it asked for the page last, closed or not."""


class TokenRefused(Exception):
    """A token that opens nothing; the message says why and ``hint`` what does."""

    def __init__(self, message: str, hint: str) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint


class Keys:
    """The token that the address bears, and the cookie for which it is traded once."""

    def __init__(self, port: int) -> None:
        self.token = secrets.token_urlsafe(32)
        self._cookie = secrets.token_urlsafe(32)
        self._name = f"studio{port}"
        self._traded = False

    def trade(self, token: object) -> str:
        """Returns the header that sets the cookie.

        Raises `TokenRefused` where this is not the token, and where it was traded before: whoever reads
        the address later, in the history of a browser or in the list of processes, gets nothing for it.
        """
        given = token.encode() if isinstance(token, str) else b""
        if not hmac.compare_digest(given, self.token.encode()):
            raise TokenRefused(
                "This is not the address of the studio that runs here.",
                "Open the one that waiter studio printed last, with all that follows the #.",
            )
        if self._traded:
            raise TokenRefused(
                "This address was opened before, in another browser or in a private window of it.",
                "It lets one browser in: go on there, or end the studio and start it again.",
            )
        self._traded = True
        return self.cookie()

    def cookie(self) -> str:
        """Returns the header that sets the cookie, for `COOKIE_SECONDS` from now."""
        return (
            f"{self._name}={self._cookie}; Path=/; Max-Age={COOKIE_SECONDS}; HttpOnly; "
            "SameSite=Strict"
        )

    def admits(self, header: str) -> bool:
        """Returns whether a ``Cookie`` header holds the cookie."""
        jar = SimpleCookie()
        try:
            jar.load(header)
        except CookieError:
            return False
        found = jar.get(self._name)
        return found is not None and hmac.compare_digest(
            found.value.encode(), self._cookie.encode()
        )


class Gate:
    """Lets through to ``app`` what comes from this page, and nothing else."""

    def __init__(self, app: App, port: int, keys: Keys) -> None:
        self._app = app
        self._keys = keys
        self._hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers as ASGI has it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if scope["type"] == "websocket":
            if refusal is not None:
                await receive()
                await send({"type": "websocket.close", "code": 1008, "reason": refusal[1]})
                return
            await self._app(scope, receive, send)
            return

        async def with_headers(message: MutableMapping[str, Any]) -> None:
            if message["type"] == "http.response.start":
                given = list(message.get("headers", ()))
                message = {**message, "headers": [*given, *HEADERS]}
            await send(message)

        if refusal is not None:
            await _say(with_headers, *refusal)
            return
        if scope["method"] == "POST":
            body = await _body(receive)
            if body is None:
                await _say(with_headers, 413, f"a body holds {MAX_BODY} bytes at most")
                return
            receive = _again(body, receive)
        await self._app(scope, receive, with_headers)

    def _refusal(self, scope: Scope) -> tuple[int, str] | None:
        """Returns the status and the words with which a request is refused."""
        host, origin, kind, cookies = (
            [value.decode("latin-1") for name, value in scope["headers"] if name == header]
            for header in (b"host", b"origin", b"content-type", b"cookie")
        )
        if len(host) != 1 or host[0].lower() not in self._hosts:
            return 421, "this is another host"
        writes = scope["type"] == "websocket" or scope["method"] == "POST"
        if writes and origin != [f"http://{host[0]}"]:
            return 403, "this comes from another page"
        if scope["type"] == "http" and scope["method"] == "POST":
            if len(kind) != 1 or kind[0].partition(";")[0].strip().lower() != "application/json":
                return 415, "only JSON is read"
        if scope["type"] == "http" and scope["path"] in OPEN_PATHS:
            return None
        if not self._keys.admits("; ".join(cookies)):
            return 401, "open the address that waiter studio printed"
        return None


async def _say(send: Send, status: int, text: str) -> None:
    headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"connection", b"close")]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": text.encode() + b"\n"})


async def _body(receive: Receive) -> bytes | None:
    """Returns the whole body, None where it is too long; no more than that is kept of it."""
    body = bytearray()
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            return bytes(body)
        body += message.get("body", b"")
        if len(body) > MAX_BODY:
            return None
        if not message.get("more_body"):
            return bytes(body)


def _again(body: bytes, receive: Receive) -> Receive:
    """Returns a ``receive`` that gives a body that was read already, then what comes after it."""
    given = False

    async def first() -> MutableMapping[str, Any]:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return first

"""Who may talk to the studio: its own page in the author's browser, and whoever knows the token.

A page of another site that the author happens to have open can send requests to this machine, so every request is
looked at: its Host (a foreign name that resolves to this machine is refused), its Origin, and the secrets of this run.

The token is for the address and for programs. It lets a browser in, which gets two other secrets: a cookie, and a key
that the page keeps and sends itself. Browsers send cookies to all ports of a host, so that other servers on this
machine come to know the cookie; without the key it opens no more than the page and its pictures.
"""

from __future__ import annotations

import asyncio
import hmac
import ipaddress
import json
import re
import secrets
import socket
from collections.abc import Mapping
from dataclasses import dataclass, field
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from shapewright.studio.project.arrivals import MOST_BYTES as MOST_FILE_BYTES

MOST_BYTES = 2**20
"""Of a request's body."""
SECONDS = 10.0
"""That the head of a request has to arrive, and then its body."""
FILES, SLOWEST = "/api/arrivals", 2**20
"""Where files arrive, which may be larger; and bytes a second that these have to come with at least."""
LOOPBACK = ("127.0.0.1", "localhost", "::1")
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'nonce-{nonce}'; img-src 'self' data: blob:; "
    "font-src 'self'; connect-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)
_HEADERS = {
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=()",
}
KEY, PROTOCOL = "x-shapewright-key", "shapewright"
"""The header that has the page's key; and the protocol of its WebSockets, which offer the key as another protocol."""
_SHOWN = re.compile(
    r"/|/assets/.*|/api/(pictures|exports)/.*|/api/(references/[^/]+|procedure)/render"
    r"|/api/runs/[^/]+/(files/.*|report\.html|parameters\.csv|parameters\.json)"
)
"""Paths that browsers ask for by themselves, as pictures and links, and so without the key."""
_ARRIVAL = (
    '<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="0;url=/#key={key}">'
    '<link rel="icon" href="data:,"><title>shapewright studio</title><a href="/#key={key}">Open the studio</a>'
)
Headers = Mapping[str, str]


def _secret() -> str:
    return secrets.token_urlsafe(32)


@dataclass(frozen=True)
class Access:
    """Who may come in."""

    host: str  # address that the server listens on
    port: int  # port that it listens on
    token: str = field(default_factory=_secret, repr=False)  # of the address, and of programs
    cookie: str = field(default_factory=_secret, repr=False)  # of the browser that was let in
    key: str = field(default_factory=_secret, repr=False)  # of the page that was let in

    @property
    def cookie_name(self) -> str:
        """Cookies do not know ports: each studio has a name of its own."""
        return f"shapewright_{self.port}"

    @property
    def address(self) -> str:
        """What the author opens."""
        name = "127.0.0.1" if _is_wildcard(self.host) else f"[{self.host}]" if ":" in self.host else self.host
        return f"http://{name}:{self.port}/?token={self.token}"

    def allows_host(self, host: str | None) -> bool:
        """Whether a Host header names this server.

        One that listens on all addresses is named by any of them, never by an unknown name: that is what a page that
        wants to get past the browser's same-origin rule would have to use.
        """
        name, _, port = (host or "").rpartition(":")
        name = name.removeprefix("[").removesuffix("]").lower()
        if port != str(self.port):
            return False
        if name in (*LOOPBACK, self.host.lower()):
            return True
        return _is_wildcard(self.host) and (_is_address(name) or name == socket.gethostname().lower())

    def allows_origin(self, headers: Headers) -> bool:
        """Whether an Origin is the server's own, as the Host of the same request has it."""
        return headers.get("origin") == f"http://{headers.get('host')}"

    def knows_secrets(self, headers: Headers, path: str, reads: bool) -> bool:
        """Whether a request has the token, or the cookie and, where a page can send it, the key."""
        if self.bears_token(headers):
            return True
        if not _same(_cookie(headers, self.cookie_name), self.cookie):
            return False
        return (reads and _SHOWN.fullmatch(path) is not None) or self._has_key(headers)

    def _has_key(self, headers: Headers) -> bool:
        offered = [word.strip() for word in headers.get("sec-websocket-protocol", "").split(",")]
        return any(_same(key, self.key) for key in (headers.get(KEY), *offered))

    def bears_token(self, headers: Headers) -> bool:
        """Whether the token is in a header that no page of another site can set."""
        kind, _, token = headers.get("authorization", "").partition(" ")
        return kind.lower() == "bearer" and _same(token, self.token)

    def admits(self, query: str) -> bool:
        """Whether a query string holds the token."""
        return any(_same(token, self.token) for token in parse_qs(query).get("token", []))


class Guard:
    """Middleware that lets in who may come in, limits what is sent, and says to the browser what a page may do."""

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self.app, self.access = app, access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = {name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]}
        refusal = self._refusal(scope, headers)
        if scope["type"] == "websocket":
            if refusal:
                await send({"type": "websocket.close", "code": 1008, "reason": refusal[1]})
                return
            await self.app(scope, receive, send)
            return
        scope["nonce"] = nonce = secrets.token_urlsafe(16)
        send = _with_headers(send, {**_HEADERS, "content-security-policy": _POLICY.format(nonce=nonce)})
        if refusal:
            await _answer(send, *refusal)
        elif scope["path"] == "/" and self.access.admits(scope["query_string"].decode("latin-1")):
            # No redirection: where another page led here, its browser would keep the cookie from what follows.
            cookie = f"{self.access.cookie_name}={self.access.cookie}; Path=/; HttpOnly; SameSite=Strict"
            kind = {"content-type": "text/html", "set-cookie": cookie, "cache-control": "no-store"}
            await send(_start(200, kind))
            await send({"type": "http.response.body", "body": _ARRIVAL.format(key=self.access.key).encode()})
        else:
            await self._pass_limited(scope, receive, send, headers)

    def _refusal(self, scope: Scope, headers: Headers) -> tuple[int, str] | None:
        """Status and reason; None for a request that may pass."""
        access, reads = self.access, scope.get("method") in ("GET", "HEAD")
        if not access.allows_host(headers.get("host")):
            return 403, "this server has another name; use the address that `shapewright studio` printed"
        if "origin" in headers and not access.allows_origin(headers):
            return 403, "requests of other pages are refused"
        if headers.get("sec-fetch-site", "none") in ("cross-site", "same-site") and scope["path"] != "/":
            return 403, "requests of other pages are refused"
        query = scope["query_string"].decode("latin-1")
        arriving = scope["type"] == "http" and scope["path"] == "/" and reads and access.admits(query)
        if not arriving and not access.knows_secrets(headers, scope["path"], reads and scope["type"] == "http"):
            return 401, "open the address with the token that `shapewright studio` printed"
        if not reads and "origin" not in headers and not access.bears_token(headers):
            return 403, "a request that changes something needs an Origin"
        if _length(headers) > (most := _most(scope)):
            return 413, f"more than {most} bytes"
        return None

    async def _pass_limited(self, scope: Scope, receive: Receive, send: Send, headers: Headers) -> None:
        """Let a request through, as long as its body is not longer than it may be, and comes in time."""
        taken, started, whole, most = 0, False, False, _most(scope)
        end = asyncio.get_running_loop().time() + SECONDS

        async def limited() -> Message:
            nonlocal taken, whole
            async with asyncio.timeout_at(None if whole else end + taken / SLOWEST):
                message = await receive()
            whole = not message.get("more_body", False)
            taken += len(message.get("body", b""))
            if taken > most:
                raise _TooLarge
            return message

        async def noted(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        try:
            await self.app(scope, limited, noted)
        except _TooLarge:
            if not started:
                await _answer(send, 413, f"more than {most} bytes")
        except TimeoutError:
            if not started:
                await _answer(send, 408, f"a request has {SECONDS:g} seconds to arrive")


class _TooLarge(Exception):
    """A body went on for longer than it may."""


def _most(scope: Scope) -> int:
    """Bytes that the body of a request may have."""
    return MOST_FILE_BYTES if scope["path"] == FILES and scope.get("method") == "POST" else MOST_BYTES


def _same(given: str | None, secret: str) -> bool:
    return given is not None and hmac.compare_digest(given.encode(), secret.encode())


def _with_headers(send: Send, more: Headers) -> Send:
    async def wrapped(message: Message) -> None:
        if message["type"] == "http.response.start":
            given = list(message.get("headers", []))
            names = {name.lower() for name, _ in given}
            given += [(n.encode(), v.encode()) for n, v in more.items() if n.encode() not in names]
            message = {**message, "headers": given}
        await send(message)

    return wrapped


async def _answer(send: Send, status: int, reason: str) -> None:
    await send(_start(status, {"content-type": "application/json", "cache-control": "no-store"}))
    await send({"type": "http.response.body", "body": json.dumps({"error": reason}).encode()})


def _start(status: int, headers: Headers) -> dict[str, Any]:
    encoded = [(name.encode(), value.encode()) for name, value in headers.items()]
    return {"type": "http.response.start", "status": status, "headers": encoded}


def _cookie(headers: Headers, name: str) -> str | None:
    try:
        morsel = SimpleCookie(headers.get("cookie", "")).get(name)
    except CookieError:
        return None
    return morsel.value if morsel else None


def _length(headers: Headers) -> int:
    value = headers.get("content-length", "0")
    return int(value) if value.isdecimal() else MOST_FILE_BYTES + 1


def _is_wildcard(host: str) -> bool:
    return host in ("0.0.0.0", "::", "")


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True

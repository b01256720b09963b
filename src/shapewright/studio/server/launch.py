"""Starting the studio: a free port, the address printed, the browser opened, and a clean end."""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
import threading
import webbrowser
from collections.abc import Callable, Sequence
from pathlib import Path

import h11
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from shapewright.studio.project.preferences import Preferences
from shapewright.studio.project.workspace import SCRATCH, Project, ProjectError
from shapewright.studio.server import kept_access
from shapewright.studio.server.app import make_app
from shapewright.studio.server.security import LOOPBACK, MOST_BYTES, SECONDS, Access
from shapewright.studio.session.session import Session

_OPENING = "open.html"
PORT = 8470
"""Tried first, so that the address stays the same from day to day."""


def serve(
    project: Project,
    preferences: Preferences,
    host: str = "127.0.0.1",
    port: int | None = None,
    allow_remote: bool = False,
    browser: bool = True,
    started: Callable[[str], object] = lambda address: None,
    keep_token: bool = False,
) -> None:
    """Serve a project until interrupted. started: called with the address, the token in it, as soon as it answers.

    port: None for PORT or, where that is taken, any. keep_token: whether the next start has the same secrets, and the
    same port if it is free, so that pages that are open then go on. Raises ProjectError when the port is taken, and for
    an address that others can reach unless ``allow_remote``.
    """
    if host not in LOOPBACK and not allow_remote:
        raise ProjectError(
            f"--host {host}: others could reach the studio there, and whoever has its token can run code as you; "
            "add --allow-remote if that is what you want"
        )
    before = kept_access.kept(project) if keep_token else None
    usual = (before.port, PORT, 0) if before else (PORT, 0)
    listening = _listen(host, usual if port is None else (port,))
    own_port = listening.getsockname()[1]
    access = before.access(host, own_port) if before else Access(host, own_port)
    if keep_token:
        kept_access.keep(project, access)
    else:
        kept_access.forget(project)
    config = uvicorn.Config(
        make_app(Session(project, preferences), access),
        log_level="warning",
        access_log=False,
        proxy_headers=False,
        server_header=False,
        ws_max_size=MOST_BYTES,
        timeout_graceful_shutdown=2,
        http=_Impatient,
    )

    def announce() -> None:
        started(access.address)
        if browser:
            page = opening_page(project, access.address)
            threading.Thread(target=webbrowser.open, args=(page.as_uri(),), daemon=True).start()

    server = _Announcing(config, announce)
    try:
        with contextlib.suppress(KeyboardInterrupt):
            server.run(sockets=[listening])
    finally:
        (project.folder / SCRATCH / _OPENING).unlink(missing_ok=True)


def opening_page(project: Project, address: str) -> Path:
    """A file for this user alone that leads to an address: programs and their arguments are seen by all users."""
    page = project.scratch() / _OPENING
    page.unlink(missing_ok=True)
    with os.fdopen(os.open(page, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as file:
        file.write(f'<!doctype html><meta http-equiv="refresh" content="0;url={address}"><a href="{address}">Open</a>')
    return page


class _Impatient(H11Protocol):
    """Closes a connection on which the head of a request does not arrive in time."""

    _waiting: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._waiting = self.loop.call_later(SECONDS, transport.close)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        if self._waiting and self.conn.their_state is not h11.IDLE:
            self._waiting.cancel()
            self._waiting = None
        elif not self._waiting and self.conn.their_state is h11.IDLE:
            self._waiting = self.loop.call_later(SECONDS, self.transport.close)


class _Announcing(uvicorn.Server):
    """A server that says when it answers."""

    def __init__(self, config: uvicorn.Config, announce: Callable[[], object]) -> None:
        super().__init__(config)
        self._announce = announce

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._announce()


def _listen(host: str, ports: Sequence[int]) -> socket.socket:
    """A socket that listens on the first of these ports that is free, 0 for any."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    reasons = []
    for number in ports:
        listening = socket.socket(family, socket.SOCK_STREAM)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, number))
        except OSError as error:
            listening.close()
            reasons.append(f"{host}:{number}: {error.strerror or error}")
            continue
        return listening
    raise ProjectError(f"cannot listen on {reasons[0]}; name another with --port")

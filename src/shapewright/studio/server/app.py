"""The studio as a web application: the page, the routes, the WebSocket, and what errors become."""

from __future__ import annotations

import asyncio
import contextlib
import mimetypes
from collections.abc import AsyncIterator, Callable
from functools import partial
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, HTMLResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from shapewright.references.errors import CollectionError
from shapewright.runs.folder import RunError
from shapewright.studio.bench.client import BenchError
from shapewright.studio.project.arrivals import Taken
from shapewright.studio.project.workspace import Conflict, Missing, ProjectError
from shapewright.studio.server import routes as api
from shapewright.studio.server.collection_routes import collection_routes
from shapewright.studio.server.security import PROTOCOL, Access, Guard
from shapewright.studio.session.job_list import Refused
from shapewright.studio.session.pages import Page
from shapewright.studio.session.session import Session
from shapewright.studio.wire import requests
from shapewright.studio.wire.changes import WrongMessage

PAGE = Path(__file__).parents[1] / "page"
_NOT_BUILT = """<!doctype html><meta charset="utf-8"><title>shapewright studio</title>
<h1>The page of the studio was not built</h1>
<p>It is made from <code>studio-page</code> when the package is installed, which needs Node and the npm registry.</p>
<p>In a checkout: <code>make page</code>, or <code>cd studio-page &amp;&amp; npm ci &amp;&amp; npm run build</code>;
then load this page again. Otherwise install shapewright again with the network there.</p>"""


def make_app(session: Session, access: Access, page: Path = PAGE) -> Starlette:
    """The application.

    page: folder of the built page.
    """
    # What the system's registry says of .js may be wrong on Windows; browsers then refuse the page's modules.
    mimetypes.add_type("text/javascript", ".js")

    @contextlib.asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        work = asyncio.create_task(session.run())
        yield
        work.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await work

    async def index(request: Request) -> Response:
        file = page / "index.html"
        text = file.read_text(encoding="utf-8") if file.is_file() else _NOT_BUILT
        headers = {"cache-control": "no-store"}
        return HTMLResponse(text.replace("__CSP_NONCE__", request.scope["nonce"]), headers=headers)

    async def asset(request: Request) -> Response:
        home = (page / "assets").resolve()
        file = (home / request.path_params["path"]).resolve()
        if not file.is_relative_to(home) or not file.is_file():
            raise Missing("there is no such file")
        return FileResponse(file, headers=api.KEEP)

    pages = [
        Route("/", index),
        Route("/assets/{path:path}", asset),
        WebSocketRoute("/api/live", partial(_converse, session)),
        *collection_routes(session),
        *api.routes(session),
    ]
    failures: dict[Any, Any] = {
        requests.Wrong: _failure(422),
        Conflict: _failure(409, "text", "digest"),
        Refused: _failure(409),
        Taken: _failure(409, "taken"),
        ProjectError: _failure(409),
        CollectionError: _failure(409),
        RunError: _failure(404),
        Missing: _failure(404),
        BenchError: _failure(503),
        HTTPException: lambda _, error: api.json_response({"error": error.detail}, error.status_code),
        ClientDisconnect: _failure(400),
    }
    guard = Middleware(Guard, access=access)
    return Starlette(routes=pages, middleware=[guard], exception_handlers=failures, lifespan=lifespan)


async def _converse(session: Session, socket: WebSocket) -> None:
    """Serve one page until it goes."""
    await socket.accept(PROTOCOL if PROTOCOL in socket.scope.get("subprotocols", []) else None)
    page = session.open_page()

    async def speak() -> None:
        while (message := await page.queue.get()) is not None:
            await (socket.send_bytes(message) if isinstance(message, bytes) else socket.send_text(message))
        await socket.close(1013)

    speaker = asyncio.create_task(speak())
    try:
        while True:
            _hear(session, page, await socket.receive_text())
    except (WebSocketDisconnect, KeyError, RuntimeError):  # it went, sent bytes, or was given up as too slow
        pass
    finally:
        speaker.cancel()
        session.close_page(page)


def _hear(session: Session, page: Page, text: str) -> None:
    try:
        message = requests.decode_page_message(text)
        if isinstance(message, requests.Visible):
            session.bench.put_first(message.slugs)
            return
        if isinstance(message, requests.Explore):
            session.bench.explore(page.number, message)
            return
        requests.check_known([message.slug], session.display.board.references)
        session.bench.evaluate(page.number, message)
    except requests.Wrong as error:
        session.pages.send(page.number, WrongMessage(error=str(error)))


def _failure(status: int, *fields: str) -> Callable[[Request, Exception], Response]:
    """What becomes of an error: its message, and the fields of it that are named."""

    def answer(request: Request, error: Exception) -> Response:
        return api.json_response({"error": str(error), **{name: getattr(error, name) for name in fields}}, status)

    return answer

"""The routes of the studio; PROTOCOL.md says what each takes and gives."""

from __future__ import annotations

import asyncio
import contextlib
import json
import mimetypes
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from shapewright.runs.folder import RunError
from shapewright.studio.bench.client import BenchError
from shapewright.studio.project.workspace import Conflict, Missing, ProjectError
from shapewright.studio.server.security import Access, Guard
from shapewright.studio.session import queries as details
from shapewright.studio.session.history import comparison, source_of
from shapewright.studio.session.pages import Page
from shapewright.studio.session.session import Refused, Session
from shapewright.studio.wire import requests as wishes

PAGE = Path(__file__).parents[1] / "page"
_KEEP = {"cache-control": "private, max-age=31536000, immutable"}
_ASIDE = {"content-security-policy": "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox"}
_DOWNLOADS = {"report.html": "text/html", "parameters.csv": "text/csv", "parameters.json": "application/json"}
_PICTURES = {".png": "image/png", ".svg": "image/svg+xml", ".glb": "model/gltf-binary"}
_NOT_BUILT = """<!doctype html><meta charset="utf-8"><title>shapewright studio</title>
<h1>The page of the studio was not built</h1>
<p>It is made from <code>studio-page</code> when the package is installed, which needs Node and the npm registry.</p>
<p>In a checkout: <code>make page</code>, or <code>cd studio-page &amp;&amp; npm ci &amp;&amp; npm run build</code>;
then load this page again. Otherwise install shapewright again with the network there.</p>"""
Handler = Callable[[Session, Request], Awaitable[Any]]


def make_app(session: Session, access: Access, page: Path = PAGE) -> Starlette:
    """The application. page: folder of the built page."""
    # What the system's registry says of .js may be wrong on Windows; browsers then refuse the page's modules.
    mimetypes.add_type("text/javascript", ".js")

    @contextlib.asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        work = asyncio.create_task(session.run())
        yield
        work.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await work

    def api(path: str, handler: Handler, method: str = "GET") -> Route:
        async def endpoint(request: Request) -> Response:
            answer = await handler(session, request)
            if isinstance(answer, Response):
                return answer
            return _json(answer, 202 if answer is None else 200)

        return Route(f"/api/{path}", endpoint, methods=[method])

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
        return FileResponse(file, headers=_KEEP)

    async def live(socket: WebSocket) -> None:
        await _converse(session, socket)

    routes = [
        Route("/", index),
        Route("/assets/{path:path}", asset),
        WebSocketRoute("/api/live", live),
        api("state", _state),
        api("pictures/{digest}.png", _picture),
        api("references/{slug}", _reference),
        api("references/{slug}/shape", _shape),
        api("references/{slug}/render", _render),
        api("source", _source),
        api("source", _write_source, "PUT"),
        api("fit", _fit, "POST"),
        api("explain", _explain, "POST"),
        api("export", _export, "POST"),
        api("exports/{name}.zip", _exported),
        api("cancel", _cancel, "POST"),
        api("settings", _settings, "PATCH"),
        api("marks", _marks, "PUT"),
        api("runs/{run}", _run),
        api("runs/{run}/restore", _restore, "POST"),
        api("runs/{run}/files/{path:path}", _run_file),
        api("runs/{run}/{name}", _run_download),
        api("compare", _compare),
        api("explanation", _explanation),
        api("suggestions/{index:int}/apply", _apply, "POST"),
    ]
    failures: dict[Any, Any] = {
        wishes.Wrong: _failure(422),
        Conflict: lambda _, error: _json({"error": str(error), "text": error.text, "digest": error.digest}, 409),
        Refused: _failure(409),
        ProjectError: _failure(409),
        RunError: _failure(404),
        Missing: _failure(404),
        BenchError: _failure(503),
        HTTPException: lambda _, error: _json({"error": error.detail}, error.status_code),
        ClientDisconnect: _failure(400),
    }
    guard = Middleware(Guard, access=access)
    return Starlette(routes=routes, middleware=[guard], exception_handlers=failures, lifespan=lifespan)


def _json(content: Any, status: int = 200) -> Response:
    return JSONResponse({} if content is None else content, status, {"cache-control": "no-store"})


def _failure(status: int) -> Callable[[Request, Exception], Response]:
    return lambda _, error: _json({"error": str(error)}, status)


async def _body(request: Request) -> Any:
    try:
        return json.loads(await request.body() or b"{}")
    except ValueError as error:
        raise wishes.Wrong(f"the body is no JSON: {error}") from error


async def _converse(session: Session, socket: WebSocket) -> None:
    """One page, until it goes."""
    await socket.accept()
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
        message = wishes.mapping(json.loads(text))
        if message.get("type") == "evaluate":
            session.evaluate(page.number, wishes.evaluation(message, session.showing.board.tiles))
        elif message.get("type") == "visible":
            session.put_first(wishes.slugs(message))
        else:
            raise wishes.Wrong("type is evaluate or visible")
    except ValueError as error:
        page.send({"type": "wrong", "error": str(error)})


async def _state(session: Session, request: Request) -> Any:
    return session.snapshot()


async def _picture(session: Session, request: Request) -> Any:
    return Response(session.showing.pictures.read(request.path_params["digest"]), media_type="image/png", headers=_KEEP)


async def _reference(session: Session, request: Request) -> Any:
    slug = _slug(session, request)
    try:
        about, _ = await session.bench.fetch({"what": "about", "slug": slug})
    except BenchError:
        about = {}
    return details.reference(session, slug, about)


async def _shape(session: Session, request: Request) -> Any:
    message, payload = await session.bench.fetch({"what": "shape", "slug": _slug(session, request)})
    return message if not payload else Response(payload, media_type="application/octet-stream", headers=_NO_STORE)


async def _render(session: Session, request: Request) -> Any:
    slug, query = _slug(session, request), request.query_params
    side = wishes.one_of({"shape": query.get("shape", "replica")}, "shape", ("reference", "replica"))
    parameters = session.showing.board.tiles[slug].parameters if side == "replica" else None
    if side == "replica" and parameters is None:
        raise Missing(f"there is no replica of {slug} yet")
    view = {
        "azimuth": wishes.number(query.get("azimuth"), 35.0, -3600.0, 3600.0),
        "elevation": wishes.number(query.get("elevation"), 25.0, -90.0, 90.0),
        "size": int(wishes.number(query.get("size"), 512, 16, 1024)),
    }
    _, payload = await session.bench.fetch({"what": "render", "slug": slug, "parameters": parameters, **view})
    return Response(payload, media_type="image/png", headers=_NO_STORE)


def _slug(session: Session, request: Request) -> str:
    slug: str = request.path_params["slug"]
    if slug not in session.showing.board.tiles:
        raise Missing(f"there is no reference {slug!r}")
    return slug


async def _source(session: Session, request: Request) -> Any:
    text, digest = session.project.read_source()
    return {"path": session.project.procedure.name, "text": text, "digest": digest}


async def _write_source(session: Session, request: Request) -> Any:
    text, expected = wishes.source(await _body(request))
    return {"digest": session.project.write_source(text, expected)}


async def _fit(session: Session, request: Request) -> Any:
    await session.fit(wishes.mapping(await _body(request)).get("fresh") is True)


async def _explain(session: Session, request: Request) -> Any:
    session.explain()


async def _export(session: Session, request: Request) -> Any:
    session.export(wishes.export(await _body(request)))


async def _exported(session: Session, request: Request) -> Any:
    folder = session.project.scratch() / "exports"
    file = folder / f"{request.path_params['name']}.zip"
    if file.resolve().parent != folder.resolve() or not file.is_file():
        raise Missing("there is no such export")
    return FileResponse(file, media_type="application/zip", filename=file.name)


async def _cancel(session: Session, request: Request) -> Any:
    session.cancel(wishes.one_of(await _body(request), "kind", tuple(session.jobs)))


async def _settings(session: Session, request: Request) -> Any:
    try:
        return session.change_preferences(wishes.mapping(await _body(request)))
    except ValueError as error:
        raise wishes.Wrong(str(error)) from error


async def _marks(session: Session, request: Request) -> Any:
    session.set_marks(wishes.marks(await _body(request), session.showing.board.tiles))
    return {}


async def _run(session: Session, request: Request) -> Any:
    return details.run_detail(session, request.path_params["run"])


async def _restore(session: Session, request: Request) -> Any:
    text = source_of(session.project.run(request.path_params["run"]))
    if not text:
        raise Missing("this run kept no procedure")
    return _replaced(session, text, wishes.digest(wishes.mapping(await _body(request))))


def _replaced(session: Session, text: str, expected: str | None) -> dict[str, Any]:
    before, _ = session.project.read_source()
    return {"digest": session.project.write_source(text, expected), "undo": before}


async def _run_file(session: Session, request: Request) -> Any:
    file = session.project.run_file(request.path_params["run"], request.path_params["path"])
    if file.suffix.lower() not in _PICTURES:
        raise Missing("pictures and replicas only")
    return FileResponse(file, media_type=_PICTURES[file.suffix.lower()], headers=_ASIDE)


async def _run_download(session: Session, request: Request) -> Any:
    name = request.path_params["name"]
    if name not in _DOWNLOADS:
        raise Missing(f"there is no {name}")
    file = session.project.run_file(request.path_params["run"], name)
    return FileResponse(file, media_type=_DOWNLOADS[name], filename=f"{file.parent.name}-{name}", headers=_ASIDE)


async def _compare(session: Session, request: Request) -> Any:
    names = [request.query_params.get(side, "") for side in ("before", "after")]
    before, after = (session.project.run(name) for name in names)
    runs = {run["run"]: run for run in session.runs()}
    found = comparison(before, after, session.showing.slugs(), session.showing.pictures.add_file)
    return {"before": runs[names[0]], "after": runs[names[1]], **found}


async def _explanation(session: Session, request: Request) -> Any:
    return details.explanation(session)


async def _apply(session: Session, request: Request) -> Any:
    wish = wishes.mapping(await _body(request))
    suggestions = details.explanation(session)["suggestions"]
    index = request.path_params["index"]
    text = suggestions[index]["source"] if index < len(suggestions) else None
    if not isinstance(text, str):
        raise Missing("this suggestion has no procedure to apply")
    if wishes.one_of(wish, "to", ("copy", "procedure")) == "procedure":
        return _replaced(session, text, wishes.digest(wish))
    return {"path": session.project.write_copy(text).name, "text": text}


_NO_STORE = {"cache-control": "no-store"}

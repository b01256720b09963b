"""The routes below ``/api``; PROTOCOL.md says what each is for."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

import msgspec
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Route

from shapewright.studio.bench.client import BenchError
from shapewright.studio.project.workspace import Missing
from shapewright.studio.session import queries
from shapewright.studio.session.history import comparison, source_of
from shapewright.studio.session.session import Session
from shapewright.studio.wire import requests
from shapewright.studio.wire.collection import Mark
from shapewright.studio.wire.detail import About
from shapewright.studio.wire.values import Slug, encode

KEEP = {"cache-control": "private, max-age=31536000, immutable"}
"""Headers of what never changes."""
_NO_STORE = {"cache-control": "no-store"}
_ASIDE = {"content-security-policy": "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox"}
_DOWNLOADS = {"report.html": "text/html", "parameters.csv": "text/csv", "parameters.json": "application/json"}
_PICTURES = {".png": "image/png", ".svg": "image/svg+xml", ".glb": "model/gltf-binary"}
Handler = Callable[[Session, Request], Awaitable[Any]]


def routes(session: Session) -> list[Route]:
    """All of them."""

    def api(path: str, handler: Handler, method: str = "GET") -> Route:
        async def endpoint(request: Request) -> Response:
            answer = await handler(session, request)
            if isinstance(answer, Response):
                return answer
            return json_response(answer, 202 if answer is None else 200)

        return Route(f"/api/{path}", endpoint, methods=[method])

    return [
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


def json_response(content: Any, status: int = 200) -> Response:
    """An answer in JSON; None is an empty object."""
    return Response(encode({} if content is None else content), status, _NO_STORE, "application/json")


async def _state(session: Session, request: Request) -> Any:
    return session.state()


async def _picture(session: Session, request: Request) -> Any:
    return Response(session.display.pictures.read(request.path_params["digest"]), media_type="image/png", headers=KEEP)


async def _reference(session: Session, request: Request) -> Any:
    slug = _slug(session, request)
    try:
        message, _ = await session.bench.process.fetch(slug, "about")
        about = msgspec.convert(message, About)
    except BenchError:
        about = None
    return queries.reference(session, slug, about)


async def _shape(session: Session, request: Request) -> Any:
    message, payload = await session.bench.process.fetch(_slug(session, request), "shape")
    return message if not payload else Response(payload, media_type="application/octet-stream", headers=_NO_STORE)


async def _render(session: Session, request: Request) -> Any:
    slug, query = _slug(session, request), request.query_params
    side = requests.one_of(query.get("shape", "replica"), "shape", ("reference", "replica"))
    parameters = session.display.board.references[slug].parameters if side == "replica" else None
    if side == "replica" and parameters is None:
        raise Missing(f"there is no replica of {slug} yet")
    _, payload = await session.bench.process.fetch(
        slug,
        "render",
        parameters=parameters,
        azimuth=requests.number(query.get("azimuth"), 35.0, -3600.0, 3600.0),
        elevation=requests.number(query.get("elevation"), 25.0, -90.0, 90.0),
        size=int(requests.number(query.get("size"), 512, 16, 1024)),
    )
    return Response(payload, media_type="image/png", headers=_NO_STORE)


def _slug(session: Session, request: Request) -> Slug:
    slug: Slug = request.path_params["slug"]
    if slug not in session.display.board.references:
        raise Missing(f"there is no reference {slug!r}")
    return slug


async def _source(session: Session, request: Request) -> Any:
    text, digest = session.project.read_source()
    return requests.Source(path=session.project.procedure.name, text=text, digest=digest)


async def _write_source(session: Session, request: Request) -> Any:
    edit = await _body(request, requests.SourceEdit)
    return requests.Written(digest=session.project.write_source(edit.text, edit.digest))


async def _fit(session: Session, request: Request) -> Any:
    await session.fit((await _body(request, requests.FitOrder)).fresh)


async def _explain(session: Session, request: Request) -> Any:
    session.jobs.explain()


async def _export(session: Session, request: Request) -> Any:
    session.jobs.export(await _body(request, requests.ExportOrder))


async def _exported(session: Session, request: Request) -> Any:
    folder = session.project.scratch() / "exports"
    file = folder / f"{request.path_params['name']}.zip"
    if file.resolve().parent != folder.resolve() or not file.is_file():
        raise Missing("there is no such export")
    return FileResponse(file, media_type="application/zip", filename=file.name)


async def _cancel(session: Session, request: Request) -> Any:
    session.jobs.cancel((await _body(request, requests.CancelOrder)).kind)


async def _settings(session: Session, request: Request) -> Any:
    try:
        return session.change_preferences(await _body(request, dict[str, Any]))
    except ValueError as error:
        raise requests.Wrong(str(error)) from error


async def _marks(session: Session, request: Request) -> Any:
    marks = await _body(request, list[Mark])
    requests.check_known([slug for mark in marks for slug in (mark.a, mark.b)], session.display.board.references)
    session.set_marks(marks)
    return {}


async def _run(session: Session, request: Request) -> Any:
    return queries.run_detail(session, request.path_params["run"])


async def _restore(session: Session, request: Request) -> Any:
    text = source_of(session.project.run(request.path_params["run"]))
    if not text:
        raise Missing("this run kept no procedure")
    return _replaced(session, text, (await _body(request, requests.RestoreOrder)).digest)


def _replaced(session: Session, text: str, expected: str | None) -> requests.Replaced:
    before, _ = session.project.read_source()
    return requests.Replaced(digest=session.project.write_source(text, expected), undo=before)


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
    runs = {run.run: run for run in session.runs()}
    return comparison(before, after, runs, session.display.slugs(), session.display.pictures.add_file)


async def _explanation(session: Session, request: Request) -> Any:
    return queries.explanation(session)


async def _apply(session: Session, request: Request) -> Any:
    order = await _body(request, requests.ApplyOrder)
    suggestions = queries.explanation(session)["suggestions"]
    index = request.path_params["index"]
    text = suggestions[index]["source"] if index < len(suggestions) else None
    if not isinstance(text, str):
        raise Missing("this suggestion has no procedure to apply")
    if order.to == "procedure":
        return _replaced(session, text, order.digest)
    return requests.Copied(path=session.project.write_copy(text).name, text=text)


async def _body(request: Request, kind: type[requests.Request]) -> requests.Request:
    return requests.decode(await request.body(), kind)

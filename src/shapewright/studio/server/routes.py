"""The routes below ``/api``; PROTOCOL.md says what each is for."""

from __future__ import annotations

import contextlib
import inspect
from collections.abc import Callable
from functools import partial
from typing import Any

import msgspec
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Route

from shapewright.procedures import source_digest
from shapewright.studio.bench.client import BenchError
from shapewright.studio.guidance import suggested
from shapewright.studio.guidance.next_step import next_step
from shapewright.studio.project.workspace import Missing, Project, ProjectError
from shapewright.studio.server.uploads import receive
from shapewright.studio.session import queries
from shapewright.studio.session.history import comparison, source_of
from shapewright.studio.session.session import Session
from shapewright.studio.wire import requests
from shapewright.studio.wire.changes import ChosenSettings
from shapewright.studio.wire.detail import About
from shapewright.studio.wire.revisions import Revision, RevisionDetail, ToldAnswer, Writer
from shapewright.studio.wire.values import Slug, encode
from shapewright.studio.wire.work import Comparison

KEEP = {"cache-control": "private, max-age=31536000, immutable"}
"""Headers of what never changes."""
_NO_STORE = {"cache-control": "no-store"}
_ASIDE = {"content-security-policy": "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox"}
_REPORT = "report.html"
_DOWNLOADS = {_REPORT: "text/html", "parameters.csv": "text/csv", "parameters.json": "application/json"}
_NO_REVISION = Missing("there is no such change of the procedure any more")
_PICTURES = {".png": "image/png", ".svg": "image/svg+xml", ".glb": "model/gltf-binary"}


def routes(session: Session) -> list[Route]:
    """All of them."""
    project, jobs = session.project, session.jobs

    return [
        api("state", lambda _: session.state()),
        api("pictures/{digest}.png", partial(_picture, session)),
        api("references/{slug}", partial(_reference, session)),
        api("references", partial(_tell, session), "PATCH", requests.TellOrder),
        api("arrivals", partial(receive, project), "POST"),
        api("references/{slug}/shape", partial(_shape, session)),
        api("references/{slug}/render", partial(_render, session)),
        api("procedure/render", partial(_render, session)),
        api("texts", lambda _: project.texts),
        api("source", lambda request: _source(_text(project, request))),
        api("source", partial(_save, project), "PUT", requests.SourceEdit),
        api("source/copy", lambda _, order: _copied(project, order.text), "POST", requests.CopyOrder),
        api("revisions", lambda request: _revisions(_text(project, request))),
        api("revisions/{number:int}", partial(_revision, project)),
        api("revisions/{number:int}/undo", partial(_undo, project), "POST", requests.RestoreOrder),
        api("fit", lambda _, order: session.fit(order.fresh), "POST", requests.FitOrder),
        api("explain", lambda _: jobs.explain(), "POST"),
        api("export", lambda _, order: jobs.export(order), "POST", requests.ExportOrder),
        api("exports/{name}.zip", partial(_exported, project)),
        api("cancel", lambda _, order: jobs.cancel(order.kind), "POST", requests.CancelOrder),
        api("settings", partial(_settings, session), "PATCH", dict[str, Any]),
        api("marks", partial(_mark, session), "PATCH", requests.MarkOrder),
        api("runs/{run}", lambda request: queries.run_detail(session, request.path_params["run"])),
        api("runs/{run}/restore", partial(_restore, project), "POST", requests.RestoreOrder),
        api("runs/{run}/files/{path:path}", partial(_run_file, project)),
        api("runs/{run}/{name}", partial(_run_download, project)),
        api("compare", partial(_compare, session)),
        api("next", lambda _: next_step(session.display.board, session.display.explanation)),
        api("explanation", lambda _: queries.explanation(session)),
        api("suggestions/{index:int}/merge", lambda request: suggested.merging(session, request.path_params["index"])),
        api("suggestions/{index:int}/apply", partial(_apply, session), "POST", requests.ApplyOrder),
    ]


def api(path: str, answer: Callable[..., Any], method: str = "GET", body: Any = None) -> Route:
    """``answer`` gets the request, and its body where that is of a type; what it returns is sent, None with 202."""

    async def endpoint(request: Request) -> Response:
        content = answer(request, *([requests.decode(await request.body(), body)] if body else []))
        if inspect.isawaitable(content):
            content = await content
        if isinstance(content, Response):
            return content
        return json_response(content, 202 if content is None else 200)

    return Route(f"/api/{path}", endpoint, methods=[method])


def json_response(content: Any, status: int = 200) -> Response:
    """An answer in JSON; None is an empty object."""
    return Response(encode({} if content is None else content), status, _NO_STORE, "application/json")


def _picture(session: Session, request: Request) -> Any:
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
    slug = _slug(session, request)
    message, payload = None, queries.kept_shape(session, slug)
    if payload is None:
        message, payload = await session.bench.process.fetch(slug, "shape")
    return message if not payload else Response(payload, media_type="application/octet-stream", headers=_NO_STORE)


async def _render(session: Session, request: Request) -> Any:
    """A picture of a reference, or of a replica: with the parameters that are given, else as it is shown."""
    query = request.query_params
    slug = _slug(session, request) if "slug" in request.path_params else None
    side = requests.one_of(query.get("shape", "replica"), "shape", ("reference", "replica"))
    shown = session.display.board.references[slug].parameters if slug is not None else None
    parameters, given = None, requests.decode(query.get("of", "{}"), requests.Given)
    if side == "replica":
        if given.parameters is None and shown is None and slug is not None:
            raise Missing(f"there is no replica of {slug} yet")
        parameters = session.authored.values(shown, given.parameters)
    elif slug is None:
        raise requests.Wrong("a reference has a name")
    try:
        _, payload = await session.bench.process.fetch(
            slug,
            "render",
            parameters=parameters,
            beyond=given.beyond,
            azimuth=requests.number(query.get("azimuth"), 35.0, -3600.0, 3600.0),
            elevation=requests.number(query.get("elevation"), 25.0, -90.0, 90.0),
            size=int(requests.number(query.get("size"), 512, 16, 1024)),
        )
    except Missing:
        if slug is not None:
            raise
        return Response(status_code=204, headers=_NO_STORE)  # a procedure that builds nothing is told elsewhere
    return Response(payload, media_type="image/png", headers=_NO_STORE)


def _slug(session: Session, request: Request) -> Slug:
    slug: Slug = request.path_params["slug"]
    if slug not in session.display.board.references:
        raise Missing(f"there is no reference {slug!r}")
    return slug


def _text(project: Project, request: Request) -> Project:
    """The project, or with the text file in the procedure's place that the query names. Raises Missing."""
    return project.of_text(request.query_params.get("file"))


def _save(project: Project, request: Request, edit: requests.SourceEdit) -> requests.Replaced:
    return _replaced(_text(project, request), edit.text, edit.digest, "editor")


def _source(project: Project) -> requests.Source:
    try:
        text, digest = project.read_source()
    except ProjectError as error:
        return requests.Source(path=project.procedure.name, text="", digest="", unreadable=str(error))
    return requests.Source(path=project.procedure.name, text=text, digest=digest)


def _revisions(text: Project) -> list[Revision]:
    if text.undo:  # nobody watches this file: what another program wrote is noticed now
        with contextlib.suppress(ProjectError):
            text.seen(None, text.read_source()[0])
    return text.revisions.all()


def _revision(project: Project, request: Request) -> RevisionDetail:
    try:
        return _text(project, request).revisions.detail(request.path_params["number"])
    except KeyError as error:
        raise _NO_REVISION from error


def _undo(project: Project, request: Request, order: requests.RestoreOrder) -> requests.Replaced:
    number, project = request.path_params["number"], _text(project, request)
    try:
        before, _ = project.revisions.texts(number)
    except KeyError as error:
        raise _NO_REVISION from error
    return _replaced(project, before, order.digest, "undo", str(number))


def _exported(project: Project, request: Request) -> Response:
    folder = project.scratch("exports")
    file = folder / f"{request.path_params['name']}.zip"
    if file.resolve().parent != folder.resolve() or not file.is_file():
        raise Missing("there is no such export")
    return FileResponse(file, media_type="application/zip", filename=file.name)


def _settings(session: Session, request: Request, given: dict[str, Any]) -> ChosenSettings:
    try:
        return session.choices.change(given)
    except ValueError as error:
        raise requests.Wrong(str(error)) from error


def _mark(session: Session, request: Request, order: requests.MarkOrder) -> dict[str, Any]:
    requests.check_known([order.a, order.b], session.display.board.references)
    session.choices.mark(order)
    return {}


def _tell(session: Session, request: Request, order: requests.TellOrder) -> ToldAnswer:
    requests.check_known(order.slugs, session.display.board.references)
    return ToldAnswer(number=session.curation.tell(dict.fromkeys(order.slugs, order.told)))


def _restore(project: Project, request: Request, order: requests.RestoreOrder) -> requests.Replaced:
    run = project.run(request.path_params["run"])
    text = source_of(run)
    if not text:
        raise Missing("this run kept no procedure")
    return _replaced(project, text, order.digest, "run", run.name)


def _replaced(project: Project, text: str, expected: str | None, writer: Writer, of: str = "") -> requests.Replaced:
    revision = project.write_source(text, expected, writer, of)
    return requests.Replaced(digest=source_digest(text), revision=revision)


def _copied(project: Project, text: str) -> requests.Copied:
    return requests.Copied(path=project.write_copy(text).name, text=text)


def _run_file(project: Project, request: Request) -> Response:
    file = project.run_file(request.path_params["run"], request.path_params["path"])
    if file.suffix.lower() not in _PICTURES:
        raise Missing("pictures and replicas only")
    return FileResponse(file, media_type=_PICTURES[file.suffix.lower()], headers=_ASIDE)


def _run_download(project: Project, request: Request) -> Response:
    name = request.path_params["name"]
    if name not in _DOWNLOADS:
        raise Missing(f"there is no {name}")
    file = project.run_file(request.path_params["run"], name)
    seen = "inline" if name == _REPORT else "attachment"  # a report is a page that opens
    named = f"{file.parent.name}-{name}"
    return FileResponse(
        file, media_type=_DOWNLOADS[name], filename=named, headers=_ASIDE, content_disposition_type=seen
    )


def _compare(session: Session, request: Request) -> Comparison:
    names = [request.query_params.get(side, "") for side in ("before", "after")]
    before, after = (session.project.run(name) for name in names)
    runs = {run.run: run for run in session.runs()}
    return comparison(before, after, runs, session.display.board.slugs, session.display.pictures.add_file)


def _apply(session: Session, request: Request, order: requests.ApplyOrder) -> requests.Replaced | requests.Copied:
    text, title = suggested.applied(session, request.path_params["index"], order.hunks, order.digest)
    if order.to == "procedure":
        return _replaced(session.project, text, order.digest, "suggestion", title)
    return _copied(session.project, text)

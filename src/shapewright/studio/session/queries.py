"""What the page asks for one thing at a time: a reference, a run, an explanation."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, cast
from urllib.parse import quote

import msgspec

from shapewright.runs.folder import read_json, read_record
from shapewright.studio.jobs.fit_job import PREDICTIONS
from shapewright.studio.project.stores.shape_store import kept_message
from shapewright.studio.project.telling import told
from shapewright.studio.project.workspace import Missing
from shapewright.studio.session.history import source_of
from shapewright.studio.session.session import Session
from shapewright.studio.wire.collection import Parameter
from shapewright.studio.wire.detail import About, Explanation, Reference
from shapewright.studio.wire.values import Slug, message_of
from shapewright.studio.wire.work import Epoch, RunDetail

_OF_SUGGESTIONS = {"title": "", "text": "", "snippet": None, "source": None, "gain": None, "tried": None}


def reference(session: Session, slug: Slug, about: About | None) -> Reference:
    """One reference in full.

    about: what the bench knows of it, if it answers.
    """
    state = session.display.board.references[slug]
    predicted = _read(session.display.run, PREDICTIONS).get(state.name, {})
    names = {parameter.name for parameter in session.authored.parameters}
    path = session.display.listed.sources[slug].path
    inside = path.is_relative_to(session.project.folder)
    return message_of(
        Reference,
        state,
        path=str(path.relative_to(session.project.folder) if inside else path),
        triangles=about.triangles if about else None,
        notes=about.notes if about else [],
        units=about.units if about else None,
        told=told(session.display.listed.sources[slug]),
        colour=state.colour(session.display.board.standard),
        **{key: _known(predicted.get(key), names) for key in ("predicted", "spread", "likelihood")},
        explanation=explanation(session)["references"].get(slug) if session.explained else None,
    )


def kept_shape(session: Session, slug: Slug) -> bytes | None:
    """The message of a large reference, where it is kept; the bench, which may be busy, is not asked then."""
    shown, up = session.display, session.authored.up
    stance = shown.recorded(shown.run).get(slug)
    if shown.cache is None or up is None or (slug in shown.listed.free and stance is None):
        return None
    return kept_message(shown.listed.kept_shape(shown.cache, slug, stance, up))


def run_detail(session: Session, name: str) -> RunDetail:
    """A whole run. Raises Missing for a run that is not there."""
    folder = session.project.run(name)
    record = read_record(folder)
    board = session.display.laid_out(folder, session.standard)
    return RunDetail(
        run=next(run for run in session.runs() if run.run == name),
        collection=board.collection(),
        values=board.parameters,
        source=source_of(folder),
        parameters=msgspec.convert(record["procedure"]["parameters"], list[Parameter]),
        settings=record["settings"],
        seconds=record["seconds"],
        curve=msgspec.convert(record["metrics"]["curve"], list[Epoch]),
        validation=record["metrics"]["validation"],
    )


def explanation(session: Session) -> Explanation:
    """Of the run that is shown: what the run's file says, by slug, with addresses of pictures. Raises Missing."""
    run, slugs = session.display.run, session.display.board.slugs
    if run is None or not session.explained:
        raise Missing("there is no explanation of this run yet")
    record = session.display.explanation
    named = {slugs[name]: of_one for name, of_one in record.get("references", {}).items() if name in slugs}
    suggestions = [_suggestion(given, run, slugs) for given in record.get("suggestions", [])]
    summary = [{**cause, **_by_slug(cause, slugs)} for cause in record.get("summary", [])]
    passed_on: Any = {**record, "references": named, "suggestions": suggestions, "summary": summary}
    return cast(Explanation, passed_on)


def _suggestion(given: Mapping[str, Any], run: Path, slugs: Mapping[str, str]) -> dict[str, Any]:
    picture = given.get("picture")
    address = f"/api/runs/{quote(run.name)}/files/{quote(picture)}" if picture else None
    return {**_OF_SUGGESTIONS, **given, "picture": address, **_by_slug(given, slugs)}


def _by_slug(given: Mapping[str, Any], slugs: Mapping[str, str]) -> dict[str, Any]:
    """The references that something is about."""
    named = [slugs[name] for name in given.get("references", []) if name in slugs]
    chosen = given.get("representative")
    return {"references": named} | ({"representative": slugs.get(chosen)} if chosen is not None else {})


def _known(values: Mapping[str, Any] | None, names: Collection[str]) -> dict[str, Any] | None:
    """The entries of parameters that still exist."""
    return {name: value for name, value in values.items() if name in names} if values else None


def _read(run: Path | None, name: str) -> dict[str, Any]:
    """A file of JSON in a run's folder, empty where there is none that can be read."""
    if run is None:
        return {}
    try:
        content: Any = read_json(run / name)
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}

"""What the page asks for one thing at a time: a reference, a run, an explanation."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote

from shapewright.runs.folder import EXPLANATION, read_json, read_record
from shapewright.studio.jobs.fit_job import PREDICTIONS
from shapewright.studio.project.workspace import Missing
from shapewright.studio.session.board import Tile, tint
from shapewright.studio.session.history import source_of
from shapewright.studio.session.session import Session

_OF_SUGGESTIONS = {"title": "", "text": "", "snippet": None, "source": None, "gain": None, "tried": None}


def reference(session: Session, slug: str, about: Mapping[str, Any]) -> dict[str, Any]:
    """The page's ``Reference``. about: what the bench knows of it. Raises Missing for a slug that is not there."""
    board = session.showing.board
    tile: Tile = board.tiles[slug]
    shown = ("slug", "name", "parameters", "distance", "iou", "chamfer", "compatible", "group", "stage")
    predicted = _read(session.showing.run, PREDICTIONS).get(tile.name, {})
    names = {parameter["name"] for parameter in session.authored.version["parameters"]}
    path = session.showing.listed.sources[slug].path
    inside = path.is_relative_to(session.project.folder)
    return {
        **{name: getattr(tile, name) for name in shown},
        "path": str(path.relative_to(session.project.folder) if inside else path),
        "triangles": None,
        "notes": [],
        "units": None,
        **about,
        "active": list(tile.active),
        "at_limit": list(tile.at_limit),
        "colour": tint(tile.distance, board.metric),
        "problem": tile.problem.record() if tile.problem else None,
        **{key: _known(predicted.get(key), names) for key in ("predicted", "spread", "likelihood")},
        "explanation": explanation(session)["references"].get(slug) if session.explained else None,
    }


def run_detail(session: Session, name: str) -> dict[str, Any]:
    """The page's ``RunDetail``. Raises Missing for a run that is not there."""
    showing = session.showing
    folder = session.project.run(name)
    record = read_record(folder)
    return {
        "run": next(run for run in session.runs() if run["run"] == name),
        "collection": showing.laid_out(folder, session.metric).record(),
        "source": source_of(folder),
        "parameters": record["procedure"]["parameters"],
        "settings": record["settings"],
        "seconds": record["seconds"],
        "curve": record["metrics"]["curve"],
        "validation": record["metrics"]["validation"],
    }


def explanation(session: Session) -> dict[str, Any]:
    """The page's ``Explanation`` of the run shown: what the run's file says, by slug, with addresses of pictures.

    Raises Missing when there is none.
    """
    run, slugs = session.showing.run, session.showing.slugs()
    if run is None or not session.explained:
        raise Missing("there is no explanation of this run yet")
    found = _read(run, EXPLANATION)
    references = found.get("references", {})
    suggestions = [_suggestion(each, run, slugs) for each in found.get("suggestions", [])]
    named = {slugs[name]: told for name, told in references.items() if name in slugs}
    summary = [{**each, **_by_slug(each, slugs)} for each in found.get("summary", [])]
    return {**found, "references": named, "suggestions": suggestions, "summary": summary}


def _suggestion(given: Mapping[str, Any], run: Path, slugs: Mapping[str, str]) -> dict[str, Any]:
    picture = given.get("picture")
    address = f"/api/runs/{quote(run.name)}/files/{quote(picture)}" if picture else None
    return {**_OF_SUGGESTIONS, **given, "picture": address, **_by_slug(given, slugs)}


def _by_slug(given: Mapping[str, Any], slugs: Mapping[str, str]) -> dict[str, Any]:
    """The references that something is about."""
    named = [slugs[name] for name in given.get("references", []) if name in slugs]
    chosen = given.get("representative")
    return {"references": named} | ({"representative": slugs.get(chosen)} if chosen is not None else {})


def _known(values: Mapping[str, Any] | None, names: set[str]) -> dict[str, Any] | None:
    """The entries of parameters that still exist."""
    return {name: value for name, value in values.items() if name in names} if values else None


def _read(run: Path | None, name: str) -> dict[str, Any]:
    """A file of JSON in a run's folder, empty where there is none that can be read."""
    if run is None:
        return {}
    try:
        found: Any = read_json(run / name)
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}

"""The routes below ``/api`` that are about many references at once, and about one in many runs."""

from __future__ import annotations

import asyncio
from functools import partial

import msgspec
from starlette.requests import Request
from starlette.routing import Route

from shapewright.studio.server.routes import api
from shapewright.studio.session.curating.glance import parameter_table, steps
from shapewright.studio.session.session import Session
from shapewright.studio.wire import requests
from shapewright.studio.wire.detail import CollectionMap, Step
from shapewright.studio.wire.revisions import ToldAnswer
from shapewright.studio.wire.values import Slug


def collection_routes(session: Session) -> list[Route]:
    """All of them."""
    return [
        api("notes", partial(_note, session), "PATCH", requests.NoteOrder),
        api("references/turn", partial(_turn, session), "POST", requests.TurnOrder),
        api("references/unit", partial(_unit, session), "POST", requests.UnitOrder),
        api("told", lambda _: session.curation.changes()),
        api("told/{number:int}/undo", partial(_undo, session), "POST"),
        api("parameters", lambda _: parameter_table(session.display)),
        api("map", partial(_map, session)),
        api("references/{slug}/steps", partial(_steps, session)),
        api("references/{slug}/alike", partial(_alike, session)),
    ]


def _note(session: Session, request: Request, order: requests.NoteOrder) -> ToldAnswer:
    requests.check_known(order.slugs, session.display.board.references)
    return ToldAnswer(number=session.curation.note(order))


async def _turn(session: Session, request: Request, order: requests.TurnOrder) -> ToldAnswer:
    requests.check_known(order.slugs, session.display.board.references)
    return ToldAnswer(number=await session.curation.turn(order.slugs, order.turn))


def _unit(session: Session, request: Request, order: requests.UnitOrder) -> ToldAnswer:
    requests.check_known(order.slugs, session.display.board.references)
    return ToldAnswer(number=session.curation.measure_in(order.slugs, order.unit))


def _undo(session: Session, request: Request) -> ToldAnswer:
    return ToldAnswer(number=session.curation.undo(request.path_params["number"]))


async def _map(session: Session, request: Request) -> CollectionMap:
    seed = int(requests.number(request.query_params.get("seed"), 0, 0, requests.MOST_SEED))
    message, _ = await session.bench.process.fetch("", "map", size=seed)
    return msgspec.convert(message, CollectionMap)


async def _steps(session: Session, request: Request) -> list[Step]:
    slug = session.known(request.path_params["slug"])
    name = session.display.board.references[slug].name
    return await asyncio.to_thread(steps, session.display, session.project.runs, name)


async def _alike(session: Session, request: Request) -> dict[Slug, float]:
    message, _ = await session.bench.process.fetch(session.known(request.path_params["slug"]), "alike")
    return msgspec.convert(message, dict[Slug, float])

"""Files that arrive from the page, written piece by piece as they come."""

from __future__ import annotations

from starlette.requests import Request

from shapewright.studio.project.arrivals import arriving
from shapewright.studio.project.workspace import Project
from shapewright.studio.wire.requests import Arrived, one_of


async def receive(project: Project, request: Request) -> Arrived:
    """Take a reference's file from the body of a request. Raises what ``arriving`` does."""
    query = request.query_params
    beside = one_of(query.get("beside", "false"), "beside", ("true", "false")) == "true"
    with arriving(project, query.get("name", ""), beside) as (file, done):
        async for piece in request.stream():
            file.write(piece)
    return done[0]

"""Shapes without references: built one by one, drawn, examined; what fails is told beside the others."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import shapely

from shapewright.modelling.solids import box
from shapewright.processes import Limits
from shapewright.shapes import Drawing, Mesh, concatenate
from shapewright.studio.bench.exploring.exploration import Exploration, examined
from shapewright.studio.bench.workshop import Workshop
from shapewright.studio.wire.answers import ExploredMessage, ExploringMessage
from shapewright.studio.wire.requests import Explore
from studio_client import PROCEDURE

SLOW = """
import time
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def slow(width: Annotated[float, Range(0.3, 1.2)] = 0.6):
    if width > 0.75:
        time.sleep(60)
    return box((width, 1, 1))
"""


def explored(folder: Path, text: str, **order: Any) -> tuple[list[Any], list[bytes]]:
    (folder / "procedure.py").write_text(text)
    workshop, told, pictures = Workshop(), list[Any](), list[bytes]()
    workshop.load(folder / "procedure.py", Limits(0.3, 1000))

    def send(message: Any, picture: bytes) -> None:
        told.append(message)
        pictures.append(picture)

    for _ in Exploration(Explore(id=7, **order), folder, workshop, send).run():
        pass
    workshop.close()
    return told, pictures


def test_all_shapes_are_drawn_and_examined(tmp_path: Path) -> None:
    (head, *shapes), (_, *pictures) = explored(tmp_path, PROCEDURE, count=5, locked={"shelf": True})
    assert isinstance(head, ExploringMessage) and len(head.shapes) == 5 and head.id == 7
    assert [one.index for one in shapes] == [*range(5)]
    assert [one.parameters for one in shapes] == head.shapes
    assert all(one.soundness.sound and one.problem is None for one in shapes)
    assert len({*pictures}) == 5 and all(picture.startswith(b"\x89PNG") for picture in pictures)


def test_too_many_that_take_too_long_end_it_and_that_is_said(tmp_path: Path) -> None:
    (head, *shapes), _ = explored(tmp_path, SLOW, vary=["width"])
    assert isinstance(shapes[-1], ExploredMessage) and shapes[-1].given_up
    late = [one for one in shapes if one.problem is not None]
    assert len(late) == 3 and {one.problem.kind for one in late} == {"time"}
    assert len(shapes) < len(head.shapes) and not any(one.given_up for one in shapes[:-1])


def test_a_condition_that_fails_is_the_problem(tmp_path: Path) -> None:
    (head,), _ = explored(tmp_path, PROCEDURE.replace("p.shelf)", "p.shelf and 1 / (p.leg < 0.1))"))
    assert head.problem is not None and "division by zero" in head.problem.message and head.shapes == []


def test_what_is_open_or_crosses_itself_is_not_sound() -> None:
    whole: Mesh = box((1, 1, 1)).mesh()
    opened = Mesh(whole.vertices, whole.faces[:-1])
    crossing = concatenate([whole, whole.transformed(np.eye(3)), box((0.5, 3, 0.5)).mesh()])
    assert examined(whole) and examined(whole).sound  # type: ignore[union-attr]
    assert not examined(opened).closed  # type: ignore[union-attr]
    assert examined(crossing).self_intersections > 0  # type: ignore[union-attr]
    assert examined(None) is None and examined(Drawing(shapely.box(0, 0, 1, 1))) is None

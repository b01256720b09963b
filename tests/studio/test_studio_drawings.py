"""The studio on drawings: the same loop, in two dimensions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import shapely

from shapewright.studio.bench.shape_messages import path
from studio_client import ready, studio

PROCEDURE = """
from typing import Annotated

import shapely

from shapewright import Range, procedure


@procedure
def sign(width: Annotated[float, Range(0.4, 2.0)] = 1.0, hole: bool = False):
    plate = shapely.box(0, 0, width, 1)
    return plate - shapely.Point(width / 2, 0.5).buffer(0.15) if hole else plate
"""
FIT = ("--samples", "40", "--epochs", "1", "--refine", "off", "--workers", "1")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "references").mkdir()
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    for name, width in (("narrow", 50), ("wide", 150)):
        text = f'<svg xmlns="http://www.w3.org/2000/svg"><rect width="{width}" height="100"/></svg>'
        (tmp_path / "references" / f"{name}.svg").write_text(text)
    return tmp_path


def test_the_loop_on_drawings(project: Path) -> None:
    with studio(project, *FIT) as running:
        state = running.wait_for(ready)
        assert state["dimension"] == 2 and state["collection"]["measure"] == "1 - VIF"
        running.wait_for(lambda s: all(tile["reference"] for tile in s["collection"]["tiles"]))
        running.listen()
        running.say(type="evaluate", id=1, slug="wide", parameters={"width": 1.5, "hole": True}, residuals=True)
        drawn = running.next(lambda m: m["type"] == "drawing")
        assert drawn["path"].count("M") == 2 and drawn["missing"].count("M") == 1 and drawn["excess"] == ""
        assert drawn["units"]["size"] == pytest.approx([1.5, 1.0])
        told = running.next(lambda m: m["type"] == "verdict")
        measures = told["measures"]
        assert 0.0 < told["distance"] < 1.0 and 0.9 < measures["iou"] < 1.0 and measures["chamfer"] < 0.05
        about = running.get("/api/references/wide")
        assert about["units"]["size"] == pytest.approx([150.0, 100.0]) and about["triangles"] is None
        assert running.get("/api/references/wide/shape")["path"].startswith("M")
        assert running.request("GET", "/api/references/wide/render?shape=reference")[1].startswith(b"\x89PNG")
        running.send("POST", "/api/fit", {}, 202)
        running.next(lambda m: m["type"] == "job" and m["job"]["state"] == "done", 120)
        state = running.get("/api/state")
        assert all(tile["replica"] and tile["distance"] is not None for tile in state["collection"]["tiles"])
        assert state["collection"]["run"] == "001"


@pytest.mark.parametrize(
    ("area", "rings"),
    [(shapely.box(0, 0, 1, 1), 1), (shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2), 2), (shapely.Polygon(), 0)],
)
def test_paths(area: Any, rings: int) -> None:
    text = path(area)
    assert text.count("M") == text.count("Z") == rings
    numbers = text.replace("M", " ").replace("L", " ").replace("Z", " ").split()
    assert len(numbers) == 8 * rings and set(map(float, numbers)) <= {0.0, 1.0, 2.0, 3.0}

"""The page of a survey: one static HTML file that needs nothing but itself."""

from __future__ import annotations

import base64
from pathlib import Path

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined

from shapewright.rendering.cameras import THUMBNAIL
from shapewright.rendering.thumbnails import thumbnails
from shapewright.shapes import Drawing
from shapewright.storage import write_file
from shapewright.survey.survey import Survey

_AXES = {"up": (1, 0.62), "front": (2, 0.72)}
"""Row of the axis in the frame of a reference, and where its arrow ends, in units of the largest extent."""


def write_page(survey: Survey, folder: Path) -> Path:
    """Write ``check.html`` into a folder and return its path."""
    environment = Environment(
        loader=PackageLoader("shapewright.survey", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    drawn = thumbnails([reference.shape for reference in survey.references], 200)
    sources = ["data:image/png;base64," + base64.b64encode(picture).decode() for picture in drawn]
    page = environment.get_template("check.html.jinja").render(
        survey=survey,
        cards=list(zip(survey.facts, sources, strict=True)),
        arrows=[] if survey.references.kind is Drawing else _arrows(),
        odd=sum(bool(facts.odd) for facts in survey.facts),
        dimensions=dimensions,
    )
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "check.html"
    write_file(path, page)
    return path


def dimensions(size: tuple[float, ...], unit: str) -> str:
    """Such as: 0.45 x 0.9 x 0.5 m."""
    return " x ".join(f"{side:.4g}" for side in size) + (" m" if unit == "m" else "")


def _arrows() -> list[tuple[str, list[float]]]:
    """The axes of a reference in a thumbnail of 100 x 100: the word, and where the arrow starts and ends."""
    found = []
    for word, (row, end) in _AXES.items():
        points = np.zeros((2, 3))
        points[0, row], points[1, row] = 0.5, end
        columns, rows, _ = THUMBNAIL.project(points, 100)
        found.append((word, [round(float(x), 1) for x in (columns[0], rows[0], columns[1], rows[1])]))
    return found

"""The reader against resvg, over a folder of public test files: set SHAPEWRIGHT_SVG_SUITE to run it.

The folder is ``crates/resvg/tests/tests`` of linebender/resvg, or any other that holds SVG files. Both sides are
compared after they are centred and scaled, as references are. Files with notes are left to their notes.
"""

import io
import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.pictures import outline
from shapewright.references.readers.svg import read_svg
from shapewright.shapes import Drawing

SUITE = Path(os.environ.get("SHAPEWRIGHT_SVG_SUITE", ""))
ROOMS = ("masking", "paint-servers", "painting", "shapes", "structure")
"""Of resvg's suite; its others are about text and filters, which are noted."""
ALIKE, SIDE = 0.95, 1200
"""Least IoU, and pixels of resvg's pictures: lines of one unit in 200 are outlined to 3 % of their area there."""
EXPLAINED = {
    "rgba-0-127-0-50percent": "resvg knows no alpha in percent",
    "valid-FuncIRI-with-a-fallback-ICC-color": "resvg paints the fallback of a gradient that exists",
    "ch-values": "resvg knows no ch",
    "q-values": "resvg knows no Q",
    "rem-values": "resvg knows no rem",
    "non-presentational-attribute": "sizes in style sheets are of SVG 2; browsers know them",
    "with-transform": "a symbol's transform is of SVG 2; browsers know it",
    "marker-on-circle": "browsers draw no markers on it",
    "marker-on-rect": "browsers draw no markers on it",
    "marker-on-rounded-rect": "browsers draw no markers on it",
    "on-ArcTo": "resvg marks the middle of an arc, which is no vertex",
    "orient=auto-on-M-L-Z": "a turn of 180 degrees has two bisectors",
    "orient=auto-on-M-L-L-Z-Z-Z": "resvg marks a closed path again for each close",
    "invalid-gradientTransform": "not defined: a transform that is flat",
    "invalid-patternTransform": "not defined: a transform that is flat",
    "recursive-nested-context": "not defined: context paints without a context",
    "on-svg": "a language of the outermost element",
    "on-the-root-svg": "black at half opacity is on the threshold",
}
resvg_py = pytest.importorskip("resvg_py", reason="compares with resvg, which is not installed")


def files():
    rooms = [SUITE / room for room in ROOMS if (SUITE / room).is_dir()] or [SUITE]
    return sorted(path for room in rooms for path in room.rglob("*.svg")) if SUITE.parts else []


def shown(path):
    """What resvg draws dark; None where that is nothing."""
    options = {"dpi": 96.0, "languages": ["en"], "resources_dir": str(path.parent)}
    picture = Image.open(io.BytesIO(bytes(resvg_py.svg_to_bytes(svg_path=str(path), width=SIDE, **options))))
    white = Image.new("RGBA", picture.size, "white")
    white.alpha_composite(picture.convert("RGBA"))
    darkness = 1.0 - np.asarray(white.convert("L"), dtype=np.float32) / np.float32(255.0)
    return Drawing(outline(darkness)).normalised().geometry if (darkness > 0.5).any() else None


@pytest.mark.skipif(not SUITE.parts, reason="SHAPEWRIGHT_SVG_SUITE names no folder of SVG files")
@pytest.mark.parametrize("path", files(), ids=lambda path: "/".join(path.parts[-3:]))
def test_it_draws_what_resvg_draws_or_notes_why_not(path):
    if path.stem in EXPLAINED:
        pytest.skip(EXPLAINED[path.stem])
    try:
        expected = shown(path)
    except ValueError as error:
        pytest.skip(f"resvg refuses it: {error}")
    try:
        drawing, notes = read_svg(path.read_bytes())
    except UnreadableError as error:
        assert expected is None or "left out" in str(error)
        return
    if notes:
        return
    assert expected is not None
    found = drawing.normalised().geometry
    assert found.intersection(expected).area / found.union(expected).area > ALIKE

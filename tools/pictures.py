"""Draw the pictures of docs/modelling.md: python tools/pictures.py [NAME ...]

Every Python block of the page is run, in order, in one namespace; a picture is of the variable that it is named after.
Colours tell labels apart; in a derivation, the boxes that it ends in.
"""

from __future__ import annotations

import contextlib
import io
import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from shapewright.modelling.grammar import Derivation
from shapewright.rendering.cameras import THUMBNAIL
from shapewright.rendering.ink import picture
from shapewright.rendering.raster import view
from shapewright.rendering.thumbnails import SUPERSAMPLE, thumbnail
from shapewright.shapes import Drawing, Mesh, concatenate
from shapewright.shapes.conversion import as_shape

PAGE = Path(__file__).parents[1] / "docs" / "modelling.md"
SIZE = 180
COLOURS = 16
PALETTE = np.array(
    [
        (214, 217, 222),
        (242, 178, 102),
        (134, 183, 226),
        (150, 205, 152),
        (236, 146, 140),
        (196, 168, 222),
        (240, 217, 120),
    ]
)


def main(names: list[str]) -> None:
    variables = run(PAGE.read_text(encoding="utf-8"))
    for name, path in pictures(PAGE.read_text(encoding="utf-8")):
        if not names or name in names:
            path.parent.mkdir(exist_ok=True)
            draw(variables[name]).save(path, optimize=True)


def blocks(page: str) -> list[tuple[str, str]]:
    """Each Python block of a page, and the text block right below it, which says what it prints."""
    found = re.findall(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?", page, re.DOTALL | re.MULTILINE)
    return [(code, printed) for code, printed in found]


def pictures(page: str) -> list[tuple[str, Path]]:
    """The name and file of each picture of a page."""
    return [(name, PAGE.parent / path) for name, path in re.findall(r"^!\[(\w+)\]\((\S+)\)$", page, re.MULTILINE)]


def run(page: str) -> dict[str, Any]:
    """The variables that the page's code leaves behind."""
    variables: dict[str, Any] = {}
    for code, _ in blocks(page):
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(code, str(PAGE), "exec"), variables)
    return variables


def draw(value: Any) -> Image.Image:
    mesh = pieces(value) if isinstance(value, Derivation) else as_shape(value)
    if isinstance(mesh, Drawing):
        return ink(mesh)
    grey = Image.open(io.BytesIO(thumbnail(mesh, SIZE))).convert("LA")
    light, alpha = np.asarray(grey, dtype=np.float64).transpose(2, 0, 1)
    rgb = np.minimum(light[..., None] * tints(mesh.normalised()) / 215.0, 255.0)
    white = rgb * alpha[..., None] / 255.0 + 255.0 - alpha[..., None]
    return Image.fromarray(white.round().astype(np.uint8)).quantize(COLOURS * 2)


def ink(drawing: Drawing) -> Image.Image:
    """Black on white, the drawing nine tenths of the picture's side."""
    shades = picture(drawing, SIZE, 4)[0].astype(np.float64)
    return Image.fromarray((255.0 - 0.85 * shades).round().astype(np.uint8)).quantize(COLOURS)


def pieces(derivation: Derivation) -> Mesh:
    """Every box that a derivation ends in, labelled by its number."""
    from shapewright.modelling.grammar.assembly import apart

    leaves = [replace(leaf, label=str(i)) for i, leaf in enumerate(derivation.leaves)]
    return concatenate([apart([leaf], derivation.tolerance) for leaf in leaves])


def tints(mesh: Mesh) -> np.ndarray[Any, Any]:
    """(SIZE, SIZE, 3): the colour of the label seen at each pixel."""
    side = SIZE * SUPERSAMPLE
    labels = mesh.face_labels if mesh.face_labels is not None else np.full(len(mesh.faces), -1)
    nearest, tint = np.zeros((side, side), dtype=np.float32), np.tile(PALETTE[0].astype(np.float64), (side, side, 1))
    for label in np.unique(labels):
        _, depth = view(Mesh(mesh.vertices, mesh.faces[labels == label]), THUMBNAIL, side)
        seen = depth > nearest
        nearest[seen] = depth[seen]
        tint[seen] = PALETTE[(label + 1) % len(PALETTE) if len(set(labels)) > 1 else 0]
    return tint.reshape(SIZE, SUPERSAMPLE, SIZE, SUPERSAMPLE, 3).mean(axis=(1, 3))


if __name__ == "__main__":
    main(sys.argv[1:])

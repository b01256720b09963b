"""Draw random shapes of examples/generators for docs/generators.md: python tools/generator_pictures.py [KIND ...]

It needs the libraries of the kinds that are drawn, as .venv-adapters has them; for blender SHAPEWRIGHT_BLENDER.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

from pictures import draw
from shapewright import load_procedure, sample

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs" / "pictures" / "generators"
GENERATORS = ROOT / "examples" / "generators"
STARTERS = ROOT / "src" / "shapewright" / "cli" / "starters"
ROWS = {
    "cadquery": [GENERATORS / "enclosure.py", GENERATORS / "flange.py", GENERATORS / "shelf_bracket.py"],
    "build123d": [GENERATORS / "angle.py", GENERATORS / "knob.py", GENERATORS / "stool.py"],
    "openscad": [GENERATORS / "toolbox.scad", GENERATORS / "planter.scad", GENERATORS / "phone_stand.scad"],
    "blender": [GENERATORS / "blender" / "shelf.blend", GENERATORS / "blender" / "column.blend"],
    "scene_synthesizer": [GENERATORS / "scene_synthesizer" / f"{name}.toml" for name in ("table", "cage", "mug")],
    "command": [GENERATORS / "command" / "tool_box.toml"],
    "drawing": [STARTERS / "drawing_page.py"],
}
"""Procedures of each kind, one a row."""
COLUMNS, TILE, COLOURS = 7, 110, 32


def main(kinds: list[str]) -> None:
    PICTURES.mkdir(exist_ok=True)
    for kind in kinds or ROWS:
        grid(ROWS[kind]).save(PICTURES / f"{kind}.png", optimize=True)


def grid(procedures: list[Path]) -> Image.Image:
    """A row of random shapes of each."""
    sheet = Image.new("RGB", (COLUMNS * TILE, len(procedures) * TILE), "white")
    for row, path in enumerate(procedures):
        builds = sample(load_procedure(path), 2 * COLUMNS, seed=3)
        shapes = [build.shape for build in builds if build.shape is not None]
        for column, shape in enumerate(shapes[:COLUMNS]):
            tile = draw(shape).convert("RGB").resize((TILE, TILE), Image.Resampling.LANCZOS)
            sheet.paste(tile, (column * TILE, row * TILE))
    return sheet.quantize(COLOURS)


if __name__ == "__main__":
    main(sys.argv[1:])

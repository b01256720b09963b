"""Draw the bundled rules, each with its name, as docs/howto.md shows them: docs/pictures/rules.png.

python tools/rules_picture.py
"""

from __future__ import annotations

import io
from pathlib import Path

from PIL import Image, ImageDraw

from shapewright.rendering.thumbnails import thumbnail
from shapewright.rules.library import bundled_rules, kinds
from shapewright.rules.rule import Rule, Stance

ROOT = Path(__file__).resolve().parents[1]
COLUMNS, TILE, CAPTION = 11, 116, 16  # tiles in a row; pixels of a tile's side, and of the line under it
SIZES: dict[
    Stance, tuple[float, float, float]
] = {  # width, height and depth in which such parts look as they do in shapes
    "under": (1, 0.8, 0.8),
    "on": (1, 0.6, 0.8),
    "beside": (0.6, 1, 0.3),
    "front": (1, 1, 0.25),
    "back": (1, 1, 0.1),
    "within": (1, 0.8, 0.6),
    "around": (1, 0.8, 0.8),
    "body": (0.8, 1, 0.8),
    "anywhere": (1, 0.4, 0.7),
}


def drawn(rules: list[Rule]) -> Image.Image:
    """All rules in rows, with their defaults."""
    rows = -(-len(rules) // COLUMNS)
    picture = Image.new("RGB", (COLUMNS * TILE, rows * (TILE + CAPTION)), "white")
    pen = ImageDraw.Draw(picture)
    for number, rule in enumerate(rules):
        tile = Image.open(io.BytesIO(thumbnail(rule(SIZES[rule.stance]).mesh(), TILE))).convert("RGBA")
        x, y = number % COLUMNS * TILE, number // COLUMNS * (TILE + CAPTION)
        picture.paste(tile, (x, y), tile)
        pen.text((x + TILE / 2, y + TILE), rule.noun, fill="#333", anchor="ma", font_size=10)
    return picture


if __name__ == "__main__":
    every = [rule for kind in kinds() for rule in bundled_rules(kind)]
    drawn(every).save(ROOT / "docs" / "pictures" / "rules.png", optimize=True)

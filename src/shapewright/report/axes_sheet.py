"""A picture of how references stand: some of them with arrows up and to the front."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from shapewright.references.orientation import AxesBy
from shapewright.rendering.cameras import THUMBNAIL
from shapewright.runs import packed

SHEET = "axes.png"
"""Its name in the folder of a run."""
_SHOWN, _COLUMNS = 24, 6
_SIDE, _TEXT = 192, 30  # pixels of a picture, and below it
_UP, _FRONT, _INK, _PAGE = (214, 96, 0), (0, 96, 190), (60, 60, 60), (255, 255, 255)
_BY: Mapping[AxesBy, str] = {
    "found": "found",
    "author": "as told",
    "format": "as its format says",
    "floor": "as its floor lies",
    "default": "as it is given",
}
_REACH = 0.72  # of an arrow, in units of the largest extent


def draw_sheet(
    folder: Path, references: Sequence[dict[str, Any]], axes: Mapping[str, Mapping[str, Any]]
) -> Image.Image:
    """Thumbnails of a run's folder with the axes of the files that point up (orange) and to the front (blue).

    First those that were turned, then those of which it is least sure.
    """

    def doubt(reference: dict[str, Any]) -> tuple[bool, float]:
        told = axes[reference["name"]]
        return told["by"] != "found", told.get("sure_up", 1.0) * told.get("sure_front", 1.0)

    shown = sorted((each for each in references if each["name"] in axes), key=doubt)[:_SHOWN]
    rows = -(-len(shown) // _COLUMNS)
    sheet = Image.new("RGB", (_COLUMNS * _SIDE, rows * (_SIDE + _TEXT)), _PAGE)
    draw = ImageDraw.Draw(sheet)
    for number, reference in enumerate(shown):
        x, y = number % _COLUMNS * _SIDE, number // _COLUMNS * (_SIDE + _TEXT)
        if content := packed.read(folder, f"thumbnails/{reference['slug']}.reference.png"):
            with Image.open(io.BytesIO(content)) as picture:
                small = picture.convert("RGBA").resize((_SIDE, _SIDE), Image.Resampling.LANCZOS)
            sheet.paste(small.convert("RGB"), (x, y), small.getchannel("A"))
        told = axes[reference["name"]]
        for tip, colour, axis in (((0.0, _REACH, 0.0), _UP, told["up"]), ((0.0, 0.0, _REACH), _FRONT, told["front"])):
            columns, lines, _ = THUMBNAIL.project(np.array([(0.0, 0.0, 0.0), tip]), _SIDE)
            ends = [(x + float(column), y + float(line)) for column, line in zip(columns, lines, strict=True)]
            draw.line(ends, fill=colour, width=2)
            draw.text((ends[1][0] + 4, ends[1][1] - 6), axis, fill=colour)
        draw.text((x + 4, y + _SIDE), reference["name"][:30], fill=_INK)
        draw.text((x + 4, y + _SIDE + 13), f"up {told['up']}, front {told['front']}: {_BY[told['by']]}", fill=_INK)
    return sheet

"""A tool box as a program of its own, which knows nothing of shapewright: tool_box.py PARAMS.json OUT.obj"""

import json
import sys
from pathlib import Path

CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def boxes(width, depth, height, wall, compartments, feet, foot_height, handle):
    """Name and two corners of each part, z up, in millimetres."""
    base = 0 if feet == "none" else foot_height
    top = base + height
    yield "bottom", (0, 0, base), (width, depth, base + wall)
    yield "left", (0, 0, base), (wall, depth, top)
    yield "right", (width - wall, 0, base), (width, depth, top)
    yield "front", (0, 0, base), (width, wall, top)
    yield "back", (0, depth - wall, base), (width, depth, top)
    for i in range(1, compartments):
        x = i * width / compartments
        yield f"divider {i}", (x - wall / 2, 0, base), (x + wall / 2, depth, top - wall)
    if feet == "rails":
        for name, y in (("front rail", 0), ("back rail", depth - 2 * wall)):
            yield name, (0, y, 0), (width, y + 2 * wall, base + 1)
    if feet == "blocks":
        size = 4 * wall
        for i, (x, y) in enumerate([(0, 0), (width - size, 0), (0, depth - size), (width - size, depth - size)]):
            yield f"foot {i}", (x, y, 0), (x + size, y + size, base + 1)
    if handle:
        middle = (depth - 2 * wall) / 2
        for name, x in (("left post", 0), ("right post", width - wall)):
            yield name, (x, middle, base), (x + wall, middle + 2 * wall, top + 60)
        yield "grip", (0, middle, top + 60), (width, middle + 2 * wall, top + 60 + 2 * wall)


def main(parameters, out):
    lines, count = [], 0
    for name, low, high in boxes(**json.loads(Path(parameters).read_text())):
        lines.append(f"o {name}")
        lines += ["v " + " ".join(str((low, high)[c][axis]) for axis, c in enumerate(corner)) for corner in CORNERS]
        lines += ["f " + " ".join(str(count + i + 1) for i in side) for side in SIDES]
        count += len(CORNERS)
    Path(out).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])

"""What the report draws of numbers: the curves of training, the places of cameras, and what of pictures is shown."""

from __future__ import annotations

import io
import math
from typing import Any

from PIL import Image


def frame(pictures: list[bytes | None]) -> dict[str, float]:
    """The part of the thumbnails that any shape covers, as a box of fractions; pages show no more than that."""
    boxes = []
    for picture in pictures:
        if picture:
            image = Image.open(io.BytesIO(picture))
            box = image.getchannel("A").getbbox() if "A" in image.getbands() else None
            boxes.append([edge / image.width for edge in box or (0, 0, image.width, image.height)])
    if not boxes:
        return {"left": 0.0, "top": 0.0, "width": 1.0, "height": 1.0}
    margin = 0.03
    left, top = (max(0.0, min(box[i] for box in boxes) - margin) for i in (0, 1))
    right, bottom = (min(1.0, max(box[i] for box in boxes) + margin) for i in (2, 3))
    return {"left": left, "top": top, "width": right - left, "height": bottom - top}


def curves(curve: list[dict[str, Any]]) -> dict[str, Any] | None:
    """Training and validation loss as paths in a box of 100 x 100, 0 at the bottom."""
    lines = {
        key: [(row["epoch"], row[key]) for row in curve if row.get(key) is not None] for key in ("train", "validation")
    }
    points = [point for line in lines.values() for point in line]
    if len({epoch for epoch, _ in points}) < 2:
        return None
    (first, last), highest = (min(points)[0], max(points)[0]), max(loss for _, loss in points) or 1.0
    paths = {
        key: "M" + "L".join(f"{(e - first) / (last - first) * 100:.2f} {100 - y / highest * 100:.2f}" for e, y in line)
        for key, line in lines.items()
        if line
    }
    return {
        "paths": paths,
        "ends": {key: line[-1][1] for key, line in lines.items() if line},
        "first": first,
        "last": last,
        "highest": highest,
    }


def cameras(places: dict[str, Any] | None) -> list[dict[str, Any]]:
    """Where each camera stood before and after training: as seen from above, the front at the bottom, and in words."""
    if not places or "after" not in places:
        return []

    def above(place: list[float]) -> tuple[float, float]:
        azimuth, elevation, distance = math.radians(place[0]), math.radians(place[1]), place[2]
        return distance * math.cos(elevation) * math.sin(azimuth), distance * math.cos(elevation) * math.cos(azimuth)

    return [
        {"from": above(before), "to": above(after), "before": before, "after": after, "moved": before != after}
        for before, after in zip(places["before"], places["after"], strict=True)
    ]

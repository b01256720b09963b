"""An angle with bolt holes and gussets, as build123d users write it: builder mode."""

from typing import Annotated, Literal

from build123d import (
    Align,
    Box,
    BuildLine,
    BuildPart,
    BuildSketch,
    GridLocations,
    Hole,
    Locations,
    Plane,
    Polyline,
    extrude,
    make_face,
)

from shapewright import Range, procedure


@procedure(up="z", unit="mm", size="given")
def angle(
    width: Annotated[float, Range(30, 80)] = 50.0,
    foot: Annotated[float, Range(30, 80)] = 50.0,
    height: Annotated[float, Range(30, 90)] = 60.0,
    thick: Annotated[float, Range(3, 10)] = 5.0,
    bolts: Annotated[int, Range(1, 3)] = 2,
    gusset: Literal["none", "one", "two"] = "one",
):
    low = (Align.CENTER, Align.MIN, Align.MIN)
    with BuildPart() as part:
        Box(width, foot, thick, align=low)
        Box(width, thick, height, align=low)
        for x in {"none": [], "one": [0.0], "two": [-0.35 * width, 0.35 * width]}[gusset]:
            with BuildSketch(Plane.YZ.offset(x)):
                with BuildLine():
                    Polyline((thick / 2, thick / 2), (0.7 * foot, thick / 2), (thick / 2, 0.7 * height), close=True)
                make_face()
            extrude(amount=thick / 2, both=True)
        with Locations((0, 0.85 * foot, thick)), GridLocations(width / (bolts + 1), 1, bolts, 1):
            Hole(0.05 * foot)
    return part

"""An L bracket with ribs, as CadQuery users write it: sketches that are extruded."""

from typing import Annotated, Literal

import cadquery as cq

from shapewright import Range, procedure


@procedure(up="z", unit="mm", size="given")
def shelf_bracket(
    width: Annotated[float, Range(30, 80)] = 50.0,
    foot: Annotated[float, Range(30, 90)] = 60.0,
    height: Annotated[float, Range(40, 120)] = 80.0,
    wall: Annotated[float, Range(3, 10)] = 5.0,
    ribs: Literal["none", "one", "two"] = "one",
    holes: bool = True,
):
    profile = [(0, 0), (foot, 0), (foot, wall), (wall, wall), (wall, height), (0, height)]
    body = cq.Workplane("XZ").polyline(profile).close().extrude(width / 2, both=True)
    for y in {"none": [], "one": [0.0], "two": [-0.35 * width, 0.35 * width]}[ribs]:
        rib = [(wall / 2, wall / 2), (0.75 * foot, wall / 2), (wall / 2, 0.75 * height)]
        body = body.union(cq.Workplane("XZ", origin=(0, y, 0)).polyline(rib).close().extrude(wall / 2, both=True))
    if holes:
        drill = cq.Workplane(origin=(0.87 * foot, 0, 0)).pushPoints([(0, -0.25 * width), (0, 0.25 * width)])
        body = body.cut(drill.circle(0.06 * width).extrude(wall))
    return body

"""A first procedure in CadQuery: every parameter of the function is a parameter of the model."""

from typing import Annotated, Literal

import cadquery as cq

from shapewright import Range, procedure


@procedure(up="z", unit="mm")  # with size="given" lengths are found as the references have them, not proportions alone
def bracket(
    width: Annotated[float, Range(20, 80)] = 40,
    foot: Annotated[float, Range(30, 90)] = 60,
    height: Annotated[float, Range(30, 90)] = 60,
    wall: Annotated[float, Range(3, 10)] = 5,
    corner: Literal["sharp", "chamfered", "round"] = "round",
    holes: bool = True,
):
    outline = [(0, 0), (foot, 0), (foot, wall), (wall, wall), (wall, height), (0, height)]
    body = cq.Workplane("XZ").polyline(outline).close().extrude(width / 2, both=True)
    edge = body.edges(cq.NearestToPointSelector((wall, 0, wall)))
    if corner == "round":
        body = edge.fillet(2 * wall)
    elif corner == "chamfered":
        body = edge.chamfer(2 * wall)
    if holes:
        body = body.faces("<Z").workplane(origin=(0.7 * foot, 0, 0)).hole(0.2 * width)
    return body

"""A pipe flange with a hub and bolt holes, as CadQuery users write it."""

from math import cos, pi, sin
from typing import Annotated

import cadquery as cq

from shapewright import Range, procedure


@procedure(up="z", unit="mm", size="given")
def flange(
    diameter: Annotated[float, Range(60, 160)] = 100.0,
    thickness: Annotated[float, Range(6, 24)] = 12.0,
    bore: Annotated[float, Range(0.15, 0.4)] = 0.25,
    hub: Annotated[float, Range(10, 50)] = 25.0,
    bolts: Annotated[int, Range(3, 8)] = 6,
):
    outer, inner = diameter / 2, bore * diameter / 2
    places = [
        (0.4 * diameter * cos(2 * pi * i / bolts), 0.4 * diameter * sin(2 * pi * i / bolts)) for i in range(bolts)
    ]
    plate = cq.Workplane().circle(outer).circle(inner).pushPoints(places).circle(0.05 * diameter).extrude(thickness)
    neck = cq.Workplane(origin=(0, 0, thickness)).circle(inner + 0.1 * diameter).circle(inner).extrude(hub)
    return plate.union(neck)

"""An electronics enclosure with a lid, as CadQuery users write it: an assembly of named parts."""

from typing import Annotated, Literal

import cadquery as cq

from shapewright import Range, procedure


@procedure(up="z", unit="mm", size="given")
def enclosure(
    length: Annotated[float, Range(60, 160)] = 100.0,
    width: Annotated[float, Range(40, 100)] = 60.0,
    height: Annotated[float, Range(15, 60)] = 30.0,
    wall: Annotated[float, Range(2, 8)] = 3.0,
    posts: bool = True,
    lid: Literal["none", "beside", "above"] = "beside",
):
    body = cq.Workplane().rect(length, width).extrude(height)
    body = body.cut(cq.Workplane(origin=(0, 0, wall)).rect(length - 2 * wall, width - 2 * wall).extrude(height))
    made = cq.Assembly(name="enclosure").add(body, name="body", color=cq.Color("gray"))
    if posts:
        inset = cq.Workplane(origin=(0, 0, wall)).rect(
            length - 4 * wall - 8, width - 4 * wall - 8, forConstruction=True
        )
        made.add(inset.vertices().circle(4).extrude(height - wall - 2), name="posts")
    if lid != "none":
        cover = cq.Workplane().rect(length, width).extrude(wall)
        place = (0, width + 15, 0) if lid == "beside" else (0, 0, height + 10)
        made.add(cover, name="lid", color=cq.Color("orange"), loc=cq.Location(place))
    return made

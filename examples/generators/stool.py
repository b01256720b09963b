"""A stool of labelled parts, as build123d users write it: a compound with children."""

from typing import Annotated

from build123d import Align, Box, Color, Compound, Cylinder, PolarLocations, Pos

from shapewright import Range, procedure

LOW = (Align.CENTER, Align.CENTER, Align.MIN)


@procedure(up="z", unit="mm", size="given")
def stool(
    width: Annotated[float, Range(250, 500)] = 350.0,
    height: Annotated[float, Range(300, 800)] = 450.0,
    seat: Annotated[float, Range(15, 60)] = 30.0,
    leg: Annotated[float, Range(15, 50)] = 30.0,
    legs: Annotated[int, Range(3, 5)] = 4,
    square: bool = False,
):
    top = Box(width, width, seat, align=LOW) if square else Cylinder(width / 2, seat, align=LOW)
    top = Pos(0, 0, height - seat) * top
    top.label, top.color = "seat", Color("burlywood")
    post = Cylinder(leg / 2, height - seat, align=LOW)
    posts = [place * post for place in PolarLocations(width / 2 - leg, legs)]
    for number, each in enumerate(posts):
        each.label = f"leg {number}"
    return Compound(label="stool", children=[top, *posts])

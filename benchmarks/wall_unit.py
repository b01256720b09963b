"""A procedure of forty parameters of all kinds, to see what many parameters cost: a wall unit of four columns."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.solids import Solid, box, cylinder

Share = Annotated[float, Range(0.5, 1.5)]
Height = Annotated[float, Range(0.4, 1.0)]
Shelves = Annotated[int, Range(0, 4)]
Front = Literal["open", "door", "drawers"]
BOARD = 0.025


@procedure
def wall_unit(
    width: Annotated[float, Range(1.2, 2.4)] = 1.8,
    height: Annotated[float, Range(0.8, 1.8)] = 1.3,
    depth: Annotated[float, Range(0.25, 0.6)] = 0.4,
    back: bool = True,
    base: Literal["floor", "plinth", "feet"] = "floor",
    base_height: Annotated[float, Range(0.05, 0.2, when=lambda p: p.base != "floor")] = 0.1,
    foot_width: Annotated[float, Range(0.04, 0.12, when=lambda p: p.base == "feet")] = 0.06,
    round_feet: Annotated[bool, When(lambda p: p.base == "feet")] = False,
    share_1: Share = 1.0,
    height_1: Height = 0.9,
    depth_1: Annotated[float, Range(0.6, 1.0)] = 1.0,
    shelves_1: Shelves = 2,
    front_1: Front = "open",
    front_height_1: Annotated[float, Range(0.25, 0.9, when=lambda p: p.front_1 != "open")] = 0.5,
    knob_1: Annotated[bool, When(lambda p: p.front_1 != "open")] = False,
    top_1: bool = False,
    share_2: Share = 1.0,
    height_2: Height = 0.7,
    depth_2: Annotated[float, Range(0.6, 1.0)] = 1.0,
    shelves_2: Shelves = 2,
    front_2: Front = "open",
    front_height_2: Annotated[float, Range(0.25, 0.9, when=lambda p: p.front_2 != "open")] = 0.5,
    knob_2: Annotated[bool, When(lambda p: p.front_2 != "open")] = False,
    top_2: bool = False,
    share_3: Share = 1.0,
    height_3: Height = 0.7,
    depth_3: Annotated[float, Range(0.6, 1.0)] = 1.0,
    shelves_3: Shelves = 2,
    front_3: Front = "open",
    front_height_3: Annotated[float, Range(0.25, 0.9, when=lambda p: p.front_3 != "open")] = 0.5,
    knob_3: Annotated[bool, When(lambda p: p.front_3 != "open")] = False,
    top_3: bool = False,
    share_4: Share = 1.0,
    height_4: Height = 0.9,
    depth_4: Annotated[float, Range(0.6, 1.0)] = 1.0,
    shelves_4: Shelves = 2,
    front_4: Front = "open",
    front_height_4: Annotated[float, Range(0.25, 0.9, when=lambda p: p.front_4 != "open")] = 0.5,
    knob_4: Annotated[bool, When(lambda p: p.front_4 != "open")] = False,
    top_4: bool = False,
):
    given = locals()
    columns = [{k[:-2]: v for k, v in given.items() if k.endswith(f"_{i}")} for i in (1, 2, 3, 4)]
    total = sum(column["share"] for column in columns)
    raised = 0.0 if base == "floor" else base_height
    left, unit = -width / 2, None
    for values in columns:
        wide = width * values["share"] / total
        part = column_of(left + wide / 2, wide, height * values["height"], depth * values["depth"], depth, back, values)
        left += wide
        unit = part if unit is None else unit | part
    unit = unit.translate((0, raised, 0))
    if base == "plinth":
        unit |= box((width - 0.1, raised + 0.01, 0.5 * depth), at=(0, raised / 2, -0.2 * depth)).label("plinth")
    if base == "feet":
        foot = (cylinder if round_feet else box)((foot_width, raised + 0.01, foot_width))
        x, z = width / 2 - 0.08, -depth / 2 + 0.08
        foot = foot.translate((x, raised / 2, z)).mirror("x", keep=True)
        unit |= (foot | foot.translate((0, 0, 0.5 * depth - 0.1))).label("feet")
    return unit


def column_of(x, wide, tall, deep, whole, back, values) -> Solid:
    """One column, its back against the wall at -whole / 2, the floor at 0."""
    z = (deep - whole) / 2

    def board(size, at):
        return box(size, at=(x + at[0], at[1], z + at[2]))

    sides = board((BOARD, tall, deep), ((BOARD - wide) / 2, tall / 2, 0)) | board(
        (BOARD, tall, deep), ((wide - BOARD) / 2, tall / 2, 0)
    )
    levels = values["shelves"] + 1
    shelves = [BOARD / 2 + i * (tall - BOARD) / levels for i in range(levels + 1)]
    unit = sides.label("sides")
    for level in shelves:
        unit |= board((wide, BOARD, deep), (0, level, 0)).label("shelves")
    if back:
        unit |= board((wide, tall, BOARD), (0, tall / 2, (BOARD - deep) / 2)).label("back")
    if values["front"] != "open":
        unit |= front_of(board, wide, tall * values["front_height"], deep, values)
    if values["top"]:
        unit |= board((wide * 0.9, 0.12, 0.5 * deep), (0, tall + 0.05, 0)).label("top box")
    return unit


def front_of(board, wide, tall, deep, values) -> Solid:
    count = 3 if values["front"] == "drawers" else 1
    gap, front = 0.02, None
    for i in range(count):
        step = tall / count
        panel = board((wide - 0.03, step - gap, 0.04), (0, (i + 0.5) * step, deep / 2)).label(values["front"])
        if values["knob"]:
            offset = 0.0 if count == 3 else 0.3 * wide
            panel |= board((0.05, 0.03, 0.1), (offset, (i + 0.5) * step, deep / 2 + 0.03)).label("knobs")
        front = panel if front is None else front | panel
    return front

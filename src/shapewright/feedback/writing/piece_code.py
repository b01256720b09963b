"""The code of one piece: its lines in the author's own terms, and what is left free in them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.feedback.parts.pieces import SLOPE, SPOKES, WIDER_FOOT, WIDER_TOP, Kind, Piece
from shapewright.feedback.parts.relations import NEW, WHOLE, Along, Frames, equal_sizes
from shapewright.feedback.writing.edit import NewParameter
from shapewright.modelling.arguments import SIDES, Side
from shapewright.parameters import Integer, Scalar

LINE = 116  # characters: 120, the style of this project (pyproject.toml), less an indent of four
_SIZES = ("width", "height", "depth")
_PLACES = ("x", "level", "z")
_FILLED: dict[Kind, str] = {
    "box": "box",
    "cylinder": "cylinder",
    "rod x": 'cylinder, along="x"',
    "rod z": 'cylinder, along="z"',
    "frustum": f"cone, top=1, bottom={WIDER_TOP}",
    "foot": f"cone, top={WIDER_FOOT}",
    "sphere": "sphere",
}
_KIT = ("between", "box", "cone", "cylinder", "face", "on", "slats", "sphere", "under", "within")
_CENTRED = 2e-3  # of its extent: how far the middle of a frame may be from the origin that copies are mirrored about


@dataclass(frozen=True)
class Quantity:
    """A scalar or integer to add."""

    name: str  # of the new parameter
    values: tuple[float, ...]  # what each misfit needs
    whole: bool = False  # whether it is an integer
    limits: tuple[float, float] | None = None  # of its Range, where a rule of the library says them

    def parameter(self, low: float, high: float, default: float, when: str | None) -> NewParameter:
        condition = f", when=lambda p: p.{when}" if when else ""
        kind, spell = ("int", lambda value: f"{round(value)}") if self.whole else ("float", number)
        annotation = f"Annotated[{kind}, Range({spell(low)}, {spell(high)}{condition})]"
        return NewParameter(self.name, annotation, spell(default))


def number(value: float) -> str:
    """A number as an author would write it: two digits that matter."""
    return f"{float(f'{value:.2g}'):g}"


def piece_lines(
    several: Sequence[Piece], frames: Sequence[Frames], frame: str, along: Sequence[Along], name: str, label: str
) -> tuple[list[str], list[Quantity]]:
    """Lines of code that make the piece with the kit's anchors, and what is free in them."""
    kind = _commonest([piece.kind for piece in several])
    sizes, lines, asked = _sizes(several, along, name)
    places, outside = _places(frame, along, several[0].mirrored, name, asked)
    count = f"{name}_count"
    if kind in SPOKES:
        asked.append(Quantity(f"{name}_breadth", tuple(piece.breadth for piece in several)))
    if kind in SPOKES or kind.startswith("slats"):
        asked.append(Quantity(count, tuple(float(piece.count) for piece in several), whole=True))
    filling = _FILLED.get(kind, "")
    if kind == "rule":
        filling, more = _of_rule(several, name, [quantity.name for quantity in asked])
        asked += more
    if kind.startswith("slats"):
        filling = _slats(several, kind[-1], sizes["xyz".index(kind[-1])], count)
    copies = ""
    for letter, axis, mirrored in zip("xz", (0, 2), several[0].mirrored, strict=True):
        if mirrored:
            ends = [each[frame][:, axis] for each in frames]
            even = all(abs(end.sum()) < _CENTRED * np.ptp(end) + 1e-9 for end in ends)
            copies += f'.mirror("{letter}", keep=True{"" if even else ", about=room.at"})'
    part = _part(frame)
    if any("room." in text for text in (*sizes, *lines, filling, copies)):
        reach = {letter: places.pop(letter) for letter in [*places] if along["xyz".index(letter)].ends}
        lines, part = [f"room = {_space(part, [], reach, [])}", *lines], "room"
    space = _space(part, sizes, places, outside)
    made, ending = f"{space}.fill({filling})", f"{copies}.label({quoted(label)})"
    if kind in SPOKES:
        lines += [f"space = {space}", *_spokes(kind, sizes[0] == sizes[2] != "None", name, _turn(several))]
        made = "around.translate(space.at)"
    elif len(f"{variable(several[0], name)} = {made}{ending}") > LINE:
        lines, made = [*lines, f"space = {space}"], f"space.fill({filling})"
    made_by = f"{variable(several[0], name)} = {made}"
    if len(made_by + ending) > LINE:  # a rule of many numbers
        return [*lines, made_by, f"{variable(several[0], name)} = {variable(several[0], name)}{ending}"], asked
    return [*lines, made_by + ending], asked


def variable(piece: Piece, name: str) -> str:
    """What a piece is called in the code; a rule of the library is a function of the same name."""
    return f"{name}_part" if piece.rule else name


def kit_functions(lines: Sequence[str]) -> tuple[str, ...]:
    """The functions of the kit that lines of code need."""
    return tuple(word for word in _KIT if any(re.search(rf"(?<![\w\".]){word}(?=[(,)])", line) for line in lines))


def noun(several: Sequence[Piece]) -> str:
    """What an author might call what these pieces become."""
    return replace(several[len(several) // 2], kind=_commonest([piece.kind for piece in several])).noun


def _sizes(several: Sequence[Piece], along: Sequence[Along], name: str) -> tuple[list[str], list[str], list[Quantity]]:
    """The size along each axis, lines that come before, and what is free in both."""
    shared = equal_sizes(several, along)
    sizes: list[str] = []
    lines: list[str] = []
    asked: list[Quantity] = []
    for axis, here in enumerate(along):
        if here.size == "full":
            sizes.append("None")
        elif axis in shared:
            sizes.append(sizes[shared[axis]])
        else:
            word = "thickness" if several[len(several) // 2].thin[axis] else _SIZES[axis]
            if any(quantity.name == f"{name}_{word}" for quantity in asked):
                word = _SIZES[axis]
            asked.append(Quantity(f"{name}_{word}", tuple(here.ratios)))
            sizes.append(f"{name}_{word} * room.{_SIZES[axis]}")
            if axis in shared.values():
                lines.append(f"{word} = {sizes[axis]}")
                sizes[axis] = word
    return sizes, lines, asked


def _places(
    frame: str, along: Sequence[Along], mirrored: tuple[bool, bool], name: str, asked: list[Quantity]
) -> tuple[dict[str, str], list[Side]]:
    """Where it lies along axes on which it is not in the middle, and the sides that it is outside of."""
    places: dict[str, str] = {}
    outside: list[Side] = []
    for axis, here in enumerate(along):
        letter, (near, far) = "xyz"[axis], SIDES[2 * axis : 2 * axis + 2]
        if here.ends:
            if {end for end, _ in here.ends} != {frame}:
                places[letter] = _reach(axis, *here.ends)
        elif here.place == "free":
            asked.append(Quantity(f"{name}_{_PLACES[axis]}", tuple(here.offsets)))
            both = axis != 1 and mirrored[axis // 2]
            places[letter] = f"(1 + {asked[-1].name}) / 2" if both else asked[-1].name
        elif here.place in ("on", "under"):
            outside.append(far if here.place == "on" else near)
        elif here.place != "middle":
            places[letter] = quoted(far if here.place == "high" else near)
    return places, outside


def _space(part: str, sizes: Sequence[str], places: Mapping[str, str], outside: Sequence[Side]) -> str:
    """The anchor at a part."""
    size = [f"({', '.join(sizes)})"] if any(size != "None" for size in sizes) else []
    places = dict(places)
    for side in outside[1:]:
        places["xyz"[SIDES.index(side) // 2]] = f'on({", ".join([part, *size])}, side="{side}")'
    arguments = ", ".join([part, *size, *(f"{letter}={places[letter]}" for letter in "xyz" if letter in places)])
    if not outside:
        return f"within({arguments})"
    if outside[0] in ("top", "bottom"):
        return f"{'on' if outside[0] == 'top' else 'under'}({arguments})"
    return f'on({arguments}, side="{outside[0]}")'


def _reach(axis: int, start: tuple[str, int], end: tuple[str, int]) -> str:
    """Where it reaches from and to: a part that it is as long as, or what it is between."""
    if start[0] == end[0]:
        return _part(start[0])
    spelled = []
    for (frame, side), towards in ((start, 1), (end, 0)):
        facing = side == towards and frame != WHOLE
        spelled.append(_part(frame) if facing else f'face({_part(frame)}, "{SIDES[2 * axis + side]}")')
    return f"between({', '.join(spelled)})"


def _slats(several: Sequence[Piece], axis: str, size: str, count: str) -> str:
    """What fills the space with slats: their gaps shrink with the count, so that any number of slats fits."""
    part = number(float(np.median([piece.gap * piece.count for piece in several])))
    across = f"room.{_SIZES['xyz'.index(axis)]}" if size == "None" else size
    return f'slats, count={count}, gap={part} * {across} / {count}, axis="{axis}"'


def _spokes(kind: Kind, is_round: bool, name: str, turn: str) -> list[str]:
    """Lines that make bars around the origin, as wide as the space."""
    inner, outer = SLOPE
    high = "space.height" if kind == "spokes" else f"{inner} * space.height"
    lines = [
        f"breadth = {name}_breadth * space.width",
        f"spoke = box(((space.width + breadth) / 2, {high}, breadth), ((space.width - breadth) / 4, 0, 0))",
    ]
    if kind == "sloping spokes":  # lower at its outer end
        rise, fall = (1 - inner) / 2, (inner * outer - 1) / 2
        ends = f"(0, {rise:g} * space.height, 0), (0, {fall:g} * space.height, 0)"
        lines.append(f'spoke = spoke.taper(({outer}, 1), "x").path({ends}, axis="x")')
    stretch = "" if is_round else ".scale((1, 1, space.depth / space.width))"
    turned = "" if turn == "0" else f".rotate({turn.format(count=f'{name}_count')})"
    return [*lines, f"around = spoke{turned}.polar_array({name}_count){stretch}"]


def _of_rule(several: Sequence[Piece], name: str, taken: Sequence[str]) -> tuple[str, list[Quantity]]:
    """What fills a space with a rule of the library, and its numbers; of choices those that most pieces have.

    taken: names of the space's own quantities.
    """
    rule = several[0].rule
    assert rule
    filling, asked = rule.name, []
    if several[0].turn:
        filling += f", turn={number(several[0].turn)}"
    for parameter in rule.space:
        values = [piece.arguments[parameter.name] for piece in several]
        if isinstance(parameter, Scalar | Integer):
            limits, whole = (parameter.low, parameter.high), parameter.whole
            own = f"{name}_{parameter.name}"
            own = f"{name}_part_{parameter.name}" if own in taken else own
            asked.append(Quantity(own, tuple(map(float, values)), whole, limits))
            filling += f", {parameter.name}={asked[-1].name}"
        elif (usual := max(dict.fromkeys(values), key=values.count)) != parameter.default:
            filling += f", {parameter.name}={usual!r}"
    return filling, asked


def _turn(several: Sequence[Piece]) -> str:
    """By how much the first of bars is turned, as most pieces have it."""
    words = ["180 / {count}" if piece.turn == 180.0 / piece.count else number(piece.turn) for piece in several]
    return max(dict.fromkeys(words), key=words.count)


def _part(frame: str) -> str:
    if frame.startswith(NEW):
        return frame.removeprefix(NEW)
    return "shape" if frame == WHOLE else f"shape.part({quoted(frame)})"


def _commonest(kinds: Sequence[Kind]) -> Kind:
    """The commonest kind; a fancy one only where most agree."""
    best = max(dict.fromkeys(kinds), key=kinds.count)
    if best in ("frustum", "foot", "sphere", "sloping spokes") and kinds.count(best) < 0.6 * len(kinds):
        return "spokes" if best == "sloping spokes" else "cylinder"
    return best


def quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'

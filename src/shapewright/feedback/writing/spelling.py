"""The lines of code that make one piece, in the author's own terms, and what is left free in them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.feedback.parts.pieces import SLOPE, SPOKES, WIDER_FOOT, WIDER_TOP, Kind, Piece
from shapewright.feedback.parts.relations import NEW, WHOLE, Along, Frames, equal_sizes
from shapewright.feedback.writing.edit import NewParameter

LINE = 116  # characters, indented by four
_CORNERS = (("left", "bottom", "back"), ("right", "top", "front"))
_SIDES = ("width", "height", "depth")
_PLACES = ("x", "level", "z")
_CALLS: dict[Kind, str] = {
    "box": "box({size}, {at})",
    "cylinder": "cylinder({size}, {at})",
    "rod x": 'cylinder({turned}).rotate(90, "z").translate({at})',
    "rod z": 'cylinder({turned}).rotate(90, "x").translate({at})',
    "frustum": f"cone({{size}}, {{at}}, top=1, bottom={WIDER_TOP})",
    "foot": f"cone({{size}}, {{at}}, top={WIDER_FOOT})",
    "sphere": "sphere({size}, {at})",
}


@dataclass(frozen=True)
class Quantity:
    """A scalar or integer to add: its name and the value that each misfit asks for."""

    name: str
    values: tuple[float, ...]
    whole: bool = False

    def parameter(self, low: float, high: float, default: float, when: str | None) -> NewParameter:
        condition = f", when=lambda p: p.{when}" if when else ""
        if self.whole:
            limits = f"{round(low)}, {round(high)}"
            return NewParameter(self.name, f"Annotated[int, Range({limits}{condition})]", f"{round(default)}")
        limits = f"{number(low)}, {number(high)}"
        return NewParameter(self.name, f"Annotated[float, Range({limits}{condition})]", number(default))


def number(value: float) -> str:
    """A number as an author would write it: two digits that matter."""
    return f"{float(f'{value:.2g}'):g}"


def piece_lines(
    several: Sequence[Piece],
    frames: Sequence[Frames],
    frame: str,
    along: Sequence[Along],
    name: str,
    label: str,
    standing: dict[str, str],
) -> tuple[list[str], list[Quantity], str]:
    """Lines of code that make the piece; what is free; the function it needs. standing: corners that lines before gave,
    and the frames they are of.
    """
    kind = _commonest([piece.kind for piece in several])
    mirrored = several[0].mirrored
    sizes: list[str] = []
    lines: list[str] = []
    asked: list[Quantity] = []
    shared: dict[int, int] = equal_sizes(several, along)
    for axis in range(3):
        if ends := along[axis].ends:
            told = ", ".join(f"{_bounds(name)}[{side}, {axis}]" for name, side in ends)
            lines.append(f"{_CORNERS[0][axis]}, {_CORNERS[1][axis]} = {told}")
    for axis in range(3):
        start, end = _CORNERS[0][axis], _CORNERS[1][axis]
        if along[axis].size == "full":
            sizes.append(f"{end} - {start}")
        elif axis in shared:
            sizes.append(sizes[shared[axis]])
        else:
            word = "thickness" if several[len(several) // 2].thin[axis] else _SIDES[axis]
            if any(quantity.name == f"{name}_{word}" for quantity in asked):
                word = _SIDES[axis]
            asked.append(Quantity(f"{name}_{word}", tuple(along[axis].ratios)))
            lines.append(f"{word} = {name}_{word} * ({end} - {start})")
            sizes.append(word)
    centres = []
    for axis in range(3):
        start, end, size = _CORNERS[0][axis], _CORNERS[1][axis], sizes[axis]
        half = f"{size} / 2"
        boxes = [each[frame] for each in frames]
        centred = along[axis].ends is None and all(
            abs(box[:, axis].sum()) < 2e-3 * np.ptp(box[:, axis]) + 1e-9 for box in boxes
        )
        middle = "0" if centred else f"({start} + {end}) / 2"
        place = along[axis].place
        if place == "free":
            word = f"{name}_{_PLACES[axis]}"
            asked.append(Quantity(word, tuple(along[axis].offsets)))
            is_mirrored = axis != 1 and mirrored[0 if axis == 0 else 1]
            from_middle = f"{word} * ({end} - {start}) / 2" if centred else f"{middle} + {word} * ({end} - {start}) / 2"
            centres.append(from_middle if is_mirrored else f"{start} + {word} * ({end} - {start})")
        else:
            where = {"middle": middle, "low": f"{start} + {half}", "high": f"{end} - {half}"}
            where |= {"on": f"{end} + {half}", "under": f"{start} - {half}"}
            centres.append(where[place])
    size, at = f"({', '.join(sizes)})", f"({', '.join(centres)})"
    gap, count = "", ""
    if kind.startswith("slats"):
        asked.append(Quantity(f"{name}_count", tuple(float(piece.count) for piece in several), whole=True))
        count = asked[-1].name
        # The gaps shrink with the count, so that any number of slats fits.
        part = float(np.median([piece.gap * piece.count for piece in several]))
        across = sizes["xyz".index(kind[-1])]
        gap = f"{number(part)} * {_operand(across)} / {count}"
    if kind in SPOKES:
        asked.append(Quantity(f"{name}_breadth", tuple(piece.breadth for piece in several)))
        asked.append(Quantity(f"{name}_count", tuple(float(piece.count) for piece in several), whole=True))
        lines += _spokes(kind, sizes, [quantity.name for quantity in asked[-2:]], _turn(several))
    middles = [f"({low} + {high}) / 2" for low, high in zip(*_CORNERS, strict=True)]
    copies = ""
    for letter, on, axis in (("x", mirrored[0], 0), ("z", mirrored[1], 2)):
        if on:
            even = all(abs(each[frame][:, axis].sum()) < 2e-3 * np.ptp(each[frame][:, axis]) + 1e-9 for each in frames)
            about = f"({middles[0]}, 0, 0)" if axis == 0 else f"(0, 0, {middles[2]})"
            copies += f'.mirror("{letter}", keep=True{"" if even else f", about={about}"})'
    line = f"{name} = {_call(kind, size, sizes, at, gap, count)}{copies}.label({quoted(label)})"
    if len(line) > LINE:
        lines.append(f"at = {at}")
        line = f"{name} = {_call(kind, size, sizes, 'at', gap, count)}{copies}.label({quoted(label)})"
    lines.append(line)
    used = "box" if kind in SPOKES else _call(kind, size, sizes, at, gap, count).split("(")[0]
    # Corners that nothing needs, or that are there already, are not asked of the frame.
    anew = [axis for axis in range(3) if along[axis].ends]
    text = "\n".join(lines)
    wanted = []
    for axis in range(3):
        words = [words[axis] for words in _CORNERS]
        needed = [word for word in words if re.search(rf"\b{word}\b", text)]
        if axis not in anew and any(standing.get(word) != frame for word in needed):
            wanted.append(axis)
        standing.update({word: NEW if axis in anew else frame for word in words if axis in anew or axis in wanted})
    pairs = [(axis, ", ".join(words[axis] for words in _CORNERS)) for axis in wanted]
    first = [f"{words} = {_bounds(frame)}[:, {axis}]" for axis, words in pairs]
    if len(wanted) == 3:
        corners = ", ".join(f"({', '.join(words)})" for words in _CORNERS)
        first = [f"{corners} = {_bounds(frame)}"]
    return [*first, *lines], asked, used


def noun(several: Sequence[Piece]) -> str:
    """What an author might call what these pieces become."""
    return replace(several[len(several) // 2], kind=_commonest([piece.kind for piece in several])).noun


def _spokes(kind: Kind, sizes: Sequence[str], names: Sequence[str], turn: str) -> list[str]:
    """Lines that make bars around the origin."""
    (width, height, depth), (share, count) = (_operand(size) for size in sizes), names
    inner, outer = SLOPE
    high = height if kind == "spokes" else f"{inner} * {height}"
    lines = [
        f"breadth = {share} * {width}",
        f"spoke = box((({width} + breadth) / 2, {high}, breadth), (({width} - breadth) / 4, 0, 0))",
    ]
    if kind == "sloping spokes":  # lower at its outer end
        ends = f"(0, {(1 - inner) / 2:g} * {height}, 0)", f"(0, {(inner * outer - 1) / 2:g} * {height}, 0)"
        lines.append(f'spoke = spoke.taper(({outer}, 1), "x").path({", ".join(ends)}, axis="x")')
    stretch = "" if width == depth else f".scale((1, 1, {depth} / {width}))"
    turned = "" if turn == "0" else f".rotate({turn.format(count=count)})"
    return [*lines, f"around = spoke{turned}.polar_array({count}){stretch}"]


def _turn(several: Sequence[Piece]) -> str:
    """By how much the first of bars is turned, as most pieces have it."""
    words = ["180 / {count}" if piece.turn == 180.0 / piece.count else number(piece.turn) for piece in several]
    return max(dict.fromkeys(words), key=words.count)


def _operand(size: str) -> str:
    return size if size.isidentifier() else f"({size})"


def _call(kind: Kind, size: str, sizes: Sequence[str], at: str, gap: str, count: str) -> str:
    if kind in SPOKES:
        return f"around.translate({at})"
    if kind.startswith("slats"):
        return f'slats({size}, {count}, {gap}, "{kind[-1]}", {at})'
    turned = f"({sizes[1]}, {sizes[0]}, {sizes[2]})" if kind == "rod x" else f"({sizes[0]}, {sizes[2]}, {sizes[1]})"
    return _CALLS[kind].format(size=size, at=at, turned=turned)


def _bounds(frame: str) -> str:
    if frame.startswith(NEW):
        return f"{frame.removeprefix(NEW)}.bounds"
    return "shape.bounds" if frame == WHOLE else f"shape.part({quoted(frame)}).bounds"


def _commonest(kinds: Sequence[Kind]) -> Kind:
    """The commonest kind; a fancy one only where most agree."""
    best = max(dict.fromkeys(kinds), key=kinds.count)
    if best in ("frustum", "foot", "sphere", "sloping spokes") and kinds.count(best) < 0.6 * len(kinds):
        return "spokes" if best == "sloping spokes" else "cylinder"
    return best


def quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'

"""Where the letters of a text stand: lists of places, anchors, sizes and spaces, without kerning or ligatures."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from shapewright.references.readers.svg import figures
from shapewright.references.readers.svg.coordinates import matrix
from shapewright.references.readers.svg.document import Element, name
from shapewright.references.readers.svg.figures import Place
from shapewright.references.readers.svg.fonts import faces
from shapewright.references.readers.svg.fonts.faces import Face, Font
from shapewright.references.readers.svg.lines.paths import Path, Pen
from shapewright.references.readers.svg.styles import Style

_SPACES = "{http://www.w3.org/XML/1998/namespace}space"
_RUNS = {"text", "tspan", "a"}
_NOT_FOLLOWED = {"textLength": "textLength", "rotate": "rotation of letters"}
_MOST = 20_000
"""Letters of a text."""
_BOLD = {"normal": 400, "bold": 700, "bolder": 700, "lighter": 300}
_CENTRE, _HANGING = 0.35, 0.75
"""How far above its line the middle and the top of a line of letters is, in sizes of letters, about."""


@dataclass(frozen=True)
class Run:
    """Letters of one style.

    Attributes:
        element: that they are in.
        place: of that element.
        outline: of all letters, in the space of the text.
    """

    element: Element
    place: Place
    outline: Path


@dataclass
class _Letter:
    text: str
    element: Element
    place: Place
    at: dict[str, float]
    """What lists of the elements tell of it: x, y, dx, dy."""


@dataclass
class _Writer:
    letters: list[_Letter] = field(default_factory=list)
    lists: list[tuple[dict[str, list[float]], int]] = field(default_factory=list)
    """Of each open element its lists, and how many letters came before it."""


def runs(
    element: Element, place: Place, style: Callable[[Element, Style], Style], own: Sequence[Face], notes: Counter[str]
) -> list[Run]:
    """What a ``text`` element shows, as outlines. What cannot be drawn is noted.

    ``style`` gives that of an element inside another one; ``own`` are the fonts of the file.
    """
    writer = _Writer()
    _collect(element, place, style, writer, notes)
    letters = _trimmed(writer.letters)
    if len(letters) > _MOST:
        notes[f"text of more than {_MOST:,} letters"] += 1
        return []
    drawn: list[Run] = []
    x = y = 0.0
    for chunk in _chunks(letters):
        x, y = chunk[0].at.get("x", x), chunk[0].at.get("y", y)
        done, x, y = _set(chunk, x, y, own, notes)
        drawn += done
    return drawn


def _collect(
    element: Element, place: Place, style: Callable[[Element, Style], Style], writer: _Writer, notes: Counter[str]
) -> None:
    lists = {key: _numbers(element.get(key), key[-1], place, notes) for key in ("x", "y", "dx", "dy")}
    for key, word in _NOT_FOLLOWED.items():
        if element.get(key) is not None:
            notes[word] += 1
    writer.lists.append((lists, len(writer.letters)))
    _write(element.text, element, place, writer)
    for child in element:
        kind = name(child)
        if kind in _RUNS:
            inner = replace(place, style=style(child, place.style))
            if inner.style.get("display") != "none":
                _collect(child, inner, style, writer, notes)
        elif kind in ("textPath", "tref"):
            notes[kind] += 1
        _write(child.tail, element, place, writer)
    writer.lists.pop()


def _numbers(text: str | None, axis: str, place: Place, notes: Counter[str]) -> list[float]:
    words = re.split(r"[\s,]+", (text or "").strip())
    return [figures.length(word, axis, place, notes) or 0.0 for word in words if word]


def _write(text: str | None, element: Element, place: Place, writer: _Writer) -> None:
    kept = any(one.get(_SPACES) == "preserve" for one in _outward(element))
    text = re.sub(r"[\t\r\n]", " ", text or "") if kept else re.sub(r"\s+", " ", text or "")
    for letter in text:
        if not kept and letter == " " and writer.letters and writer.letters[-1].text == " ":
            continue
        at: dict[str, float] = {}
        for lists, before in writer.lists:
            place_in = len(writer.letters) - before
            at |= {key: values[place_in] for key, values in lists.items() if place_in < len(values)}
        writer.letters.append(_Letter(letter, element, place, at))


def _outward(element: Element) -> Iterator[Element]:
    yield element
    yield from element.iterancestors()


def _trimmed(letters: list[_Letter]) -> list[_Letter]:
    def is_space(letter: _Letter) -> bool:
        return letter.text == " " and all(one.get(_SPACES) != "preserve" for one in _outward(letter.element))

    start, end = 0, len(letters)
    while start < end and is_space(letters[start]):
        if start + 1 < end:
            letters[start + 1].at = letters[start].at | letters[start + 1].at
        start += 1
    while end > start and is_space(letters[end - 1]):
        end -= 1
    return letters[start:end]


def _chunks(letters: Sequence[_Letter]) -> Iterator[list[_Letter]]:
    """Letters that stand beside one another: each absolute place begins a chunk."""
    chunk: list[_Letter] = []
    for letter in letters:
        if chunk and ("x" in letter.at or "y" in letter.at):
            yield chunk
            chunk = []
        chunk.append(letter)
    if chunk:
        yield chunk


def _set(
    chunk: list[_Letter], x: float, y: float, own: Sequence[Face], notes: Counter[str]
) -> tuple[list[Run], float, float]:
    """The runs of a chunk that begins at a place, and where it ends."""
    start, placed = x, list[tuple[_Letter, Font, float, float]]()
    for letter in chunk:
        x, y = x + letter.at.get("dx", 0.0), y + letter.at.get("dy", 0.0)
        font = _font(letter, own, notes)
        wide = None if font is None else _width(font, letter.text)
        if font is None or wide is None:
            if font is not None:
                notes["letter that its font does not have"] += 1
            continue
        placed.append((letter, font, x, y))
        x += wide * letter.place.font / font.units + _space(letter, notes)
    anchor = chunk[0].place.style.get("text-anchor", "start")
    shift = {"middle": (start - x) / 2, "end": start - x}.get(anchor, 0.0)
    return list(_outlined(placed, shift)), x + shift, y


def _outlined(placed: Sequence[tuple[_Letter, Font, float, float]], shift: float) -> Iterator[Run]:
    pen, of = Pen(), None
    for letter, font, x, y in placed:
        if of is not None and letter.element is not of.element:
            yield Run(of.element, of.place, pen.path())
            pen = Pen()
        of, size = letter, letter.place.font / font.units
        base = y + _baseline(letter) * letter.place.font
        to = faces.pen_of(matrix(size, 0.0, 0.0, -size, x + shift, base), pen)(font.glyphs)
        font.draw(letter.text, to)
    if of is not None:
        yield Run(of.element, of.place, pen.path())


def _width(font: Font, letter: str) -> float | None:
    name_ = font.names.get(ord(letter))
    return None if name_ is None else float(font.glyphs[name_].width)


def _space(letter: _Letter, notes: Counter[str]) -> float:
    """What style sheets add behind a letter."""
    keys = ("letter-spacing", "word-spacing") if letter.text == " " else ("letter-spacing",)
    words = [letter.place.style.get(key, "normal") for key in keys]
    return sum(figures.length(word, "x", letter.place, notes) or 0.0 for word in words if word != "normal")


def _baseline(letter: _Letter) -> float:
    told = letter.place.style.get("dominant-baseline", "auto")
    return {"middle": _CENTRE - 0.08, "central": _CENTRE, "hanging": _HANGING, "text-before-edge": 0.9}.get(told, 0.0)


def _font(letter: _Letter, own: Sequence[Face], notes: Counter[str]) -> Font | None:
    """The font of a letter; None, with a note, where there is none or it cannot set the letter."""
    style = letter.place.style
    if unicodedata.bidirectional(letter.text) in ("R", "AL", "AN") or unicodedata.combining(letter.text):
        notes["letter of a script that is joined or runs to the left"] += 1
        return None
    if style.get("writing-mode", "horizontal-tb") not in ("horizontal-tb", "lr-tb", "lr"):
        notes["letter of a line that runs down"] += 1
        return None
    families = re.split(r"\s*,\s*", style.get("font-family", faces.USUAL))
    weight = style.get("font-weight", "normal").strip()
    heavy = _BOLD.get(weight) or (int(weight) if weight.isdecimal() else 400)
    slanted = style.get("font-style", "normal").startswith(("italic", "oblique"))
    face = faces.choose(own, families, heavy, slanted)
    if face is None:
        notes[f"letter of the font {families[0][:40]}, which is not on this machine, left out"] += 1
        return None
    try:
        found = faces.opened(face)
        _width(found, letter.text)
    except Exception:  # noqa: BLE001 - a broken font can make its parser fail in any way
        notes["letter of a font that is broken"] += 1
        return None
    if not isinstance(face.source, bytes):
        notes[f"letter, drawn in {face.family} of this machine"] += 1
    return found

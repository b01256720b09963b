"""Lengths, transforms and view boxes: how numbers of a file become places on its page."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.shapes import Floats

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_LENGTH = re.compile(rf"({NUMBER})\s*(%|[a-zA-Z]*)")
_FUNCTION = re.compile(r"\s*,?\s*([a-zA-Z]+)\s*\(([^()]*)\)")
_ARGUMENT = re.compile(rf"\s*,?\s*({NUMBER})(%|[a-zA-Z]*)")
_PIXELS = {"": 1.0, "px": 1.0, "pt": 4 / 3, "pc": 16.0, "in": 96.0, "cm": 96 / 2.54, "mm": 96 / 25.4, "q": 24 / 25.4}
"""Of each unit (CSS Values, "Absolute lengths")."""
_LETTERS = {"em": 1.0, "ex": 0.5, "ch": 0.5}
"""Of the size of the font; that of ex and ch is what CSS takes where the font does not tell."""
ROOT_FONT = 16.0
"""Pixels: the size of letters where nothing says it, as in browsers."""
_DEGREES = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": 180.0 / math.pi, "turn": 360.0}


@dataclass(frozen=True)
class Viewport:
    """What percentages refer to, in units of the user's space.

    Attributes:
        width: of the page or of the innermost ``svg`` or ``symbol``.
        height: likewise.
    """

    width: float
    height: float

    def length(self, text: str, axis: str, font: float = ROOT_FONT, root: float = ROOT_FONT) -> float:
        """A length in user units. Raises ValueError for no length.

        Args:
            text: a number with or without a unit, or a percentage.
            axis: "x", "y", or "" for neither: what a percentage is of.
            font: the size of letters.
            root: the size of letters of the outermost element, the unit rem.
        """
        match = _LENGTH.fullmatch(text.strip())
        if match is None:
            raise ValueError(f"no length: {text}")
        value, unit = float(match[1]), match[2].lower()
        if unit == "%":
            diagonal = math.hypot(self.width, self.height) / math.sqrt(2.0)
            return value / 100.0 * {"x": self.width, "y": self.height, "": diagonal}[axis]
        if unit in _LETTERS or unit == "rem":
            return value * (_LETTERS[unit] * font if unit in _LETTERS else root)
        if unit not in _PIXELS:
            raise ValueError(f"no length: {text}")
        return value * _PIXELS[unit]


def matrix(a: float = 1.0, b: float = 0.0, c: float = 0.0, d: float = 1.0, e: float = 0.0, f: float = 0.0) -> Floats:
    """(3, 3) with the order of SVG: x' = ax + cy + e, y' = bx + dy + f."""
    return np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])


def apply(transform: Floats, points: Floats) -> Floats:
    """Points (..., 2), moved."""
    return points @ transform[:2, :2].T + transform[:2, 2]


def inverse(transform: Floats) -> Floats:
    """The matrix back from the page."""
    return np.asarray(np.linalg.inv(transform), dtype=np.float64)


def transform(text: str) -> Floats:
    """The matrix of a list such as "translate(3 4) rotate(30)". Raises ValueError for anything else."""
    result, end = matrix(), 0
    text = text.strip()
    while end < len(text):
        match = _FUNCTION.match(text, end)
        if match is None:
            raise ValueError(f"no transform: {text}")
        result, end = result @ _single(match[1], _arguments(match[2])), match.end()
    return result


def _arguments(text: str) -> list[tuple[float, str]]:
    found = [(float(number), unit.lower()) for number, unit in _ARGUMENT.findall(text)]
    if _ARGUMENT.sub("", text).strip():
        raise ValueError(f"no numbers: {text}")
    return found


def _single(kind: str, arguments: Sequence[tuple[float, str]]) -> Floats:
    """The matrix of one function, of SVG or CSS."""
    count = len(arguments)
    numbers = [_absolute(number, unit) for number, unit in arguments]
    angles = [math.radians(number * _DEGREES[unit]) if unit in _DEGREES else math.nan for number, unit in arguments]
    match kind, count:
        case "matrix", 6:
            return matrix(*numbers)
        case (("translate" | "translateX"), 1):
            return matrix(e=numbers[0])
        case "translateY", 1:
            return matrix(f=numbers[0])
        case "translate", 2:
            return matrix(e=numbers[0], f=numbers[1])
        case "scale", (1 | 2):
            return matrix(a=numbers[0], d=numbers[-1])
        case "scaleX", 1:
            return matrix(a=numbers[0])
        case "scaleY", 1:
            return matrix(d=numbers[0])
        case (("rotate" | "rotateZ"), 1):
            sine, cosine = math.sin(angles[0]), math.cos(angles[0])
            return matrix(cosine, sine, -sine, cosine)
        case "rotate", 3:
            about = matrix(e=numbers[1], f=numbers[2])
            return about @ _single("rotate", arguments[:1]) @ matrix(e=-numbers[1], f=-numbers[2])
        case (("skewX" | "skew"), 1):
            return matrix(c=math.tan(angles[0]))
        case "skewY", 1:
            return matrix(b=math.tan(angles[0]))
        case "skew", 2:
            return matrix(b=math.tan(angles[1]), c=math.tan(angles[0]))
    raise ValueError(f"no transform: {kind} of {count} numbers")


def _absolute(number: float, unit: str) -> float:
    if unit == "%":
        raise ValueError("a transform in percent")
    return number * _PIXELS.get(unit, 1.0)


def view_box(text: str | None) -> tuple[float, float, float, float] | None:
    """Left, top, width and height; None where there is none or it is no good."""
    numbers = [float(number) for number in re.findall(NUMBER, text or "")]
    if len(numbers) != 4 or not min(numbers[2:]) > 0.0:
        return None
    return numbers[0], numbers[1], numbers[2], numbers[3]


def fitted(box: tuple[float, float, float, float], width: float, height: float, ratio: str | None) -> Floats:
    """The matrix that shows a view box on an area from (0, 0), by the rules of ``preserveAspectRatio``."""
    left, top, wide, high = box
    x, y = width / wide, height / high
    words = [word for word in (ratio or "").split() if word != "defer"] or ["xMidYMid"]
    places = re.fullmatch(r"x(Min|Mid|Max)Y(Min|Mid|Max)", words[0])
    if words[0] == "none":
        return matrix(x, 0.0, 0.0, y, -left * x, -top * y)
    scale = max(x, y) if "slice" in words[1:] else min(x, y)
    share = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    along, down = (share[places[1]], share[places[2]]) if places else (0.5, 0.5)
    return matrix(
        scale,
        0.0,
        0.0,
        scale,
        (width - wide * scale) * along - left * scale,
        (height - high * scale) * down - top * scale,
    )

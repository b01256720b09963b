"""Fonts: those that a file brings along, and those of this machine, in an order that is the same each time."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from shapewright.shapes import Floats

_FOLDERS = {
    "linux": ("/usr/share/fonts", "/usr/local/share/fonts", "~/.local/share/fonts", "~/.fonts"),
    "darwin": ("/System/Library/Fonts", "/Library/Fonts", "~/Library/Fonts"),
    "win32": ("C:/Windows/Fonts", "~/AppData/Local/Microsoft/Windows/Fonts"),
}
"""Where systems keep fonts; of Linux as fontconfig's own settings name them."""
_ENDS = (".ttf", ".otf", ".ttc", ".otc")
_MOST = 3000
"""Fonts of a machine that are looked at."""
_SERIF = ("dejavu serif", "liberation serif", "noto serif", "times new roman", "times", "georgia")
_SANS = ("dejavu sans", "liberation sans", "noto sans", "arial", "helvetica", "segoe ui", "verdana")
_MONO = ("dejavu sans mono", "liberation mono", "noto sans mono", "courier new", "menlo", "consolas", "courier")
_GENERIC = {
    "serif": _SERIF,
    "sans-serif": _SANS,
    "monospace": _MONO,
    "system-ui": _SANS,
    "ui-sans-serif": _SANS,
    "ui-serif": _SERIF,
    "ui-monospace": _MONO,
}
_ALIKE = {
    "arial": ("liberation sans", "arimo", "helvetica"),
    "helvetica": ("liberation sans", "arimo", "arial"),
    "times new roman": ("liberation serif", "tinos", "times"),
    "times": ("liberation serif", "tinos", "times new roman"),
    "courier new": ("liberation mono", "cousine", "courier"),
    "courier": ("liberation mono", "cousine", "courier new"),
}
"""Fonts whose letters are as wide, as fontconfig pairs them (30-metric-aliases.conf)."""
USUAL = "serif"
"""What browsers use where a text names no font."""


@dataclass(frozen=True)
class Face:
    """A font, and what style sheets choose it by.

    Attributes:
        family: its name, in small letters.
        weight: 100 to 900; 400 is regular, 700 bold.
        slanted: whether it is italic or oblique.
        source: its file, or its bytes.
        number: of the font in a file of several.
    """

    family: str
    weight: int
    slanted: bool
    source: Path | bytes
    number: int = 0


def choose(own: Sequence[Face], families: Sequence[str], weight: int, slanted: bool) -> Face | None:
    """The font for the families that a style sheet lists: the first one that is there, of the nearest style.

    Fonts of the file come before those of the machine.
    """
    for family in families:
        name = family.strip().strip("\"'").strip().lower()
        alternatives = _GENERIC.get(name) or (name, *_ALIKE.get(name, ()))
        for faces in (own, machine_faces()):
            for alternative in alternatives:
                alike = [face for face in faces if face.family == alternative]
                if alike:
                    return min(alike, key=lambda face: (face.slanted != slanted, abs(face.weight - weight)))
    return None


@cache
def machine_faces() -> tuple[Face, ...]:
    """The fonts of this machine, in the order of their paths."""
    return tuple(_found(tuple(Path(folder).expanduser() for folder in _FOLDERS.get(sys.platform, ()))))


def _found(folders: Sequence[Path]) -> Iterator[Face]:
    walked = (Path(root, name) for folder in folders for root, _, names in os.walk(folder) for name in names)
    for path in sorted(path for path in walked if path.suffix.lower() in _ENDS)[:_MOST]:
        yield from faces_in(path)


def faces_in(source: Path | bytes) -> Iterator[Face]:
    """The fonts in a file, or in its bytes; none where it is broken."""
    from fontTools.ttLib import TTCollection, TTFont

    try:
        file: Any = io.BytesIO(source) if isinstance(source, bytes) else str(source)
        start = source[:4] if isinstance(source, bytes) else source.open("rb").read(4)
        fonts = TTCollection(file, lazy=True).fonts if start == b"ttcf" else [TTFont(file, lazy=True)]
        for number, font in enumerate(fonts):
            names, style = font["name"], font["OS/2"]
            for family in {names.getDebugName(16), names.getDebugName(1)} - {None}:
                slanted = bool(style.fsSelection & 0b1000000001)  # the bits of italic and oblique
                yield Face(family.lower(), int(style.usWeightClass), slanted, source, number)
    except Exception:  # noqa: BLE001 - a broken font can make its parser fail in any way
        return


@dataclass(frozen=True)
class Font:
    """A font that is open.

    Attributes:
        units: of its own in the size of a letter.
        rise: of the highest letters above the line, in its units; ``fall`` of the lowest ones below it, negative.
        glyphs: by their names; ``names`` are those of letters, by their code.
    """

    units: float
    rise: float
    fall: float
    glyphs: Any
    names: dict[int, str]

    def draw(self, letter: str, to: Any) -> float | None:
        """Draw a letter to a pen of fontTools; how wide it is, in units of the font, or None where it is not there."""
        name = self.names.get(ord(letter))
        if name is None:
            return None
        self.glyphs[name].draw(to)
        return float(self.glyphs[name].width)


@lru_cache(maxsize=16)
def opened(face: Face) -> Font:
    """The font of a face. It fails in any way where the file is broken."""
    from fontTools.ttLib import TTFont

    file: Any = io.BytesIO(face.source) if isinstance(face.source, bytes) else str(face.source)
    font = TTFont(file, fontNumber=face.number, lazy=True)
    across = font["hhea"]
    return Font(
        float(font["head"].unitsPerEm), float(across.ascent), float(across.descent), font.getGlyphSet(),
        font.getBestCmap() or {},
    )  # fmt: skip


def pen_of(matrix: Floats, to: Any) -> Any:
    """A pen of fontTools that draws to ours, moved by a matrix (3, 3)."""
    from fontTools.pens.basePen import BasePen

    (a, c, e), (b, d, f), _ = matrix

    def moved(point: tuple[float, float]) -> tuple[float, float]:
        x, y = point
        return a * x + c * y + e, b * x + d * y + f

    class Moved(BasePen):  # type: ignore[misc] # what fontTools asks for, which turns quadratic curves into cubic ones
        def _moveTo(self, pt: tuple[float, float]) -> None:  # noqa: N802
            to.move(moved(pt))

        def _lineTo(self, pt: tuple[float, float]) -> None:  # noqa: N802
            to.line(moved(pt))

        def _curveToOne(self, pt1: Any, pt2: Any, pt3: Any) -> None:  # noqa: N802
            to.curve(moved(pt1), moved(pt2), moved(pt3))

        def _closePath(self) -> None:  # noqa: N802
            to.close()

    return Moved

"""The cascade: attributes, style sheets and ``style`` attributes, and what is inherited of them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any, TypeAlias

import cssselect2
import tinycss2
from tinycss2 import color4

from shapewright.references.readers.svg.coordinates import ROOT_FONT, Viewport
from shapewright.references.readers.svg.document import Document, Element
from shapewright.references.readers.svg.fonts.embedded import faces_of
from shapewright.references.readers.svg.fonts.faces import Face

Style: TypeAlias = dict[str, str]
"""The computed value of each property that an element has."""
_INHERITED = {
    "color",
    "fill",
    "fill-rule",
    "fill-opacity",
    "stroke",
    "stroke-width",
    "stroke-opacity",
    "stroke-dasharray",
    "stroke-dashoffset",
    "stroke-linecap",
    "stroke-linejoin",
    "stroke-miterlimit",
    "clip-rule",
    "marker-start",
    "marker-mid",
    "marker-end",
    "visibility",
    "font-size",
    "font-family",
    "font-weight",
    "font-style",
    "text-anchor",
    "letter-spacing",
    "word-spacing",
    "writing-mode",
    "dominant-baseline",
    "paint-order",
    "color-interpolation",
}
_OWN = {
    "display",
    "opacity",
    "clip-path",
    "mask",
    "mask-type",
    "filter",
    "mix-blend-mode",
    "vector-effect",
    "overflow",
    "transform",
    "transform-origin",
    "stop-color",
    "stop-opacity",
    "x",
    "y",
    "width",
    "height",
    "r",
    "cx",
    "cy",
    "rx",
    "ry",
    "marker",
    "clip",
}
_PLACES = {"x", "y", "width", "height", "r", "cx", "cy", "rx", "ry"}
_WIDE = {"inherit", "initial", "unset", "revert"}
_COLOURS = {"color", "stop-color", "fill", "stroke"}
_SHEETS = ("", "text/css")
_VARIABLE = re.compile(r"var\(\s*(--[\w-]+)\s*(?:,([^()]*(?:\([^()]*\)[^()]*)*))?\)")
_PERCENT_ALPHA = re.compile(r",\s*([\d.]+)%\s*\)$")
_FONT_SIZES = {"xx-small": 0.5625, "x-small": 0.625, "small": 0.8125, "medium": 1.0, "large": 1.125, "x-large": 1.5}
"""Of the medium size (CSS Fonts, "font-size")."""


class Cascade:
    """Which declarations hold for the elements of a document.

    Attributes:
        notes: how often each thing was met that is not understood.
        faces: the fonts that the file brings along.
    """

    def __init__(self, document: Document) -> None:
        self.notes: Counter[str] = Counter()
        self.faces: list[Face] = []
        self._matched: dict[Element, list[tuple[str, str, bool]]] = {}
        matcher = cssselect2.Matcher()
        for sheet in document.styles:
            if sheet.get("type", "").strip().lower() in _SHEETS and self._applies(sheet.get("media", "")):
                text = "".join(sheet.itertext())
                self._add(matcher, tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True))
        if matcher.order:
            for wrapper in cssselect2.ElementWrapper.from_xml_root(document.root).iter_subtree():
                found = [one for *_, pseudo, rule in matcher.match(wrapper) if pseudo is None for one in rule]
                if found:
                    self._matched[wrapper.etree_element] = found

    def style(self, element: Element, parent: Mapping[str, str]) -> Style:
        """What holds for an element whose parent, or whose ``use``, has the given style."""
        style = {key: value for key, value in parent.items() if key in _INHERITED or key.startswith("--")}
        own = dict(self._declared(element))
        style |= {key: value for key, value in own.items() if key.startswith("--")}
        for key, value in own.items():
            if "var(" in value:
                value = _substituted(value, style)
            word = value.lower()
            if key in _PLACES and word in _WIDE:
                style.pop(key, None)
            elif key == "overflow" and word in _WIDE and not (word == "inherit" and key in parent):
                style[key] = "visible"  # which it is not by default on some elements
            elif word == "inherit" or (word == "unset" and key in _INHERITED):
                if key in parent:
                    style[key] = parent[key]
                else:
                    style.pop(key, None)
            elif word in ("initial", "unset", "revert"):
                style.pop(key, None)
            elif key not in _COLOURS or is_paint(value):
                style[key] = value
        if "font-size" in own:
            style["font-size"] = _font_size(own["font-size"], parent)
        style["rem"] = parent.get("rem", style.get("font-size", str(ROOT_FONT)))
        return style

    def inherited(self, element: Element) -> Style:
        """The style of an element's parent, in the tree of the document."""
        above = list(element.iterancestors())[::-1]
        style: Style = {}
        for one in above:
            style = self.style(one, style)
        return style

    def _declared(self, element: Element) -> Iterator[tuple[str, str]]:
        """Pairs of a property and its value; later ones win."""
        for key, value in element.attrib.items():
            if key in _INHERITED or (key in _OWN and key != "marker"):
                yield key, value.strip()
        styled = self._matched.get(element, []) + inline(element.get("style", ""))
        for wanted in (False, True):
            for key, value, important in styled:
                if important == wanted:
                    yield from _longhands(key, value)

    def _add(self, matcher: Any, rules: Any) -> None:
        for rule in rules:
            if rule.type == "qualified-rule":
                declarations = _declarations(tinycss2.parse_blocks_contents(rule.content, True, True))
                try:
                    for selector in cssselect2.compile_selector_list(rule.prelude):
                        matcher.add_selector(selector, declarations)
                except cssselect2.SelectorError:
                    self.notes["selector of a style sheet"] += 1
            elif rule.type == "at-rule" and rule.lower_at_keyword == "media":
                if self._applies(tinycss2.serialize(rule.prelude)):
                    self._add(matcher, tinycss2.parse_rule_list(rule.content, True, True))
            elif rule.type == "at-rule" and rule.lower_at_keyword == "font-face":
                self.faces += faces_of(rule)
            elif rule.type == "at-rule" and rule.lower_at_keyword == "import":
                self.notes["style sheet of another file"] += 1
            elif rule.type == "at-rule" and rule.lower_at_keyword in ("supports", "layer", "container", "scope"):
                self.notes[f"@{rule.lower_at_keyword}"] += 1

    def _applies(self, query: str) -> bool:
        """Whether rules are for a light screen; what depends on its size is noted, and is not for it."""
        return not query.strip() or any(self._matches(part.strip().lower()) for part in query.split(","))

    def _matches(self, query: str) -> bool:
        conditions = re.findall(r"\(([^()]*)\)", query)
        words = re.sub(r"\([^()]*\)", " ", query).split()
        unknown = [one for one in conditions if not one.startswith("prefers-color-scheme")]
        if unknown:
            self.notes["@media " + query] += 1
            return False
        holds = all(one.split(":")[-1].strip() == "light" for one in conditions)
        kinds = [word for word in words if word not in ("and", "not", "only")]
        holds = holds and all(kind in ("all", "screen") for kind in kinds)
        return holds != ("not" in words)


def inline(text: str) -> list[tuple[str, str, bool]]:
    """Property, value and whether it is important, of the text of a ``style`` attribute."""
    return list(_inline(text)) if text else []


def is_paint(value: str) -> bool:
    """Whether it is a value of ``fill``, ``stroke`` or a colour; others count as not written."""
    word = value.lower()
    return word in ("none", "context-fill", "context-stroke") or word.startswith("url(") or colour(value) is not None


@lru_cache(maxsize=4096)
def colour(value: str) -> tuple[float, float, float, float] | None:
    """Red, green, blue and alpha from 0 to 1; -1 for ``currentColor``; None for no colour."""
    text = re.sub(r"\s*icc-color\(.*", "", value.strip())
    parsed = color4.parse_color(text) or color4.parse_color(_PERCENT_ALPHA.sub(_number, text))
    if parsed is None:
        return None
    if isinstance(parsed, str):
        return (-1.0, -1.0, -1.0, 1.0)
    try:
        red, green, blue = (min(max(float(part or 0.0), 0.0), 1.0) for part in parsed.to("srgb").coordinates)
    except NotImplementedError:  # of spaces that go by lightness, the lightness is what counts here
        whole = 1.0 if parsed.space.startswith("ok") else 100.0
        red = green = blue = float(parsed.coordinates[0] or 0.0) / whole
    return red, green, blue, float(parsed.alpha)


def _number(match: re.Match[str]) -> str:
    return f", {float(match[1]) / 100.0})"


@lru_cache(maxsize=4096)
def _inline(text: str) -> tuple[tuple[str, str, bool], ...]:
    return tuple(_declarations(tinycss2.parse_blocks_contents(text, skip_comments=True, skip_whitespace=True)))


def _declarations(parsed: Any) -> list[tuple[str, str, bool]]:
    return [
        (
            one.name if one.name.startswith("--") else one.lower_name,
            tinycss2.serialize(one.value).strip(),
            one.important,
        )
        for one in parsed
        if one.type == "declaration"
    ]


def _longhands(key: str, value: str) -> Iterator[tuple[str, str]]:
    if key == "marker":
        yield from ((f"marker-{place}", value) for place in ("start", "mid", "end"))
    elif key == "font":
        size = re.search(r"(?<![\w.])([\d.]+(?:px|pt|em|ex|mm|cm|in|pc|rem|%))(?:\s*/\s*[\w.%]+)?\s*(.*)", value)
        if size:
            before = value[: size.start()].split()
            yield "font-size", size[1]
            yield "font-family", size[2]
            yield "font-style", next((word for word in before if word in ("italic", "oblique")), "normal")
            yield (
                "font-weight",
                next((word for word in before if word.startswith("bold") or word.isdecimal()), "normal"),
            )
    else:
        yield key, value


def _substituted(value: str, style: Mapping[str, str], depth: int = 0) -> str:
    """A value with the custom properties in place of each ``var()``."""
    if depth > 8 or len(value) > 1000:
        return ""
    value = _VARIABLE.sub(lambda match: style.get(match[1], (match[2] or "").strip()), value)
    return _substituted(value, style, depth + 1) if "var(" in value else value


def _font_size(value: str, parent: Mapping[str, str]) -> str:
    above = float(parent.get("font-size", ROOT_FONT))
    word = value.lower()
    if word in _FONT_SIZES:
        return str(_FONT_SIZES[word] * ROOT_FONT)
    if word in ("larger", "smaller"):
        return str(above * 1.2 if word == "larger" else above / 1.2)
    try:
        return str(Viewport(above, above).length(value, "x", above, float(parent.get("rem", ROOT_FONT))))
    except ValueError:
        return str(above)

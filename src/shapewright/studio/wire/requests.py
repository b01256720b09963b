"""What pages ask for in JSON, checked before anything is done with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from shapewright.shapes.files import FORMATS

PARTS = ("replicas", "samples", "report", "parameters")
MOST_SAMPLES = 10_000


class Wrong(ValueError):
    """A request makes no sense; the message says what it should be."""


def evaluation(given: Mapping[str, Any], slugs: Mapping[str, Any]) -> dict[str, Any]:
    """A request for live evaluation. slugs: those that there are."""
    number, slug = given.get("id"), given.get("slug")
    if not isinstance(number, int) or isinstance(number, bool):
        raise Wrong("id is a whole number")
    if slug is not None and slug not in slugs:
        raise Wrong(f"there is no reference {slug!r}")
    values = given.get("parameters")
    if values is not None and not (
        isinstance(values, dict) and all(isinstance(value, str | int | float | bool) for value in values.values())
    ):
        raise Wrong("parameters are a mapping of names to values, or null")
    return {"id": number, "slug": slug, "parameters": values, "residuals": given.get("residuals") is True}


def slugs(given: Mapping[str, Any]) -> list[str]:
    """Slugs that are visible."""
    found = given.get("slugs")
    if not isinstance(found, list) or not all(isinstance(slug, str) for slug in found):
        raise Wrong("slugs is a list of strings")
    return found


def source(given: Any) -> tuple[str, str | None]:
    """Text and expected digest."""
    wish = mapping(given)
    text = wish.get("text")
    if not isinstance(text, str):
        raise Wrong("text is a string")
    return text, digest(wish)


def digest(given: Mapping[str, Any]) -> str | None:
    found = given.get("digest")
    if found is not None and not isinstance(found, str):
        raise Wrong("digest is a string or null")
    return found


def marks(given: Any, known: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Pairs of slugs that there are."""
    if not isinstance(given, list):
        raise Wrong("marks are a list")
    for mark in given:
        pair = mapping(mark)
        if pair.get("a") not in known or pair.get("b") not in known or not isinstance(pair.get("same"), bool):
            raise Wrong("a mark has a, b (slugs of references) and same (true or false)")
    return [{name: mark[name] for name in ("a", "b", "same")} for mark in given]


def export(given: Any) -> dict[str, Any]:
    """What to pack."""
    wish = mapping(given)
    what, format = wish.get("what"), wish.get("format", "glb")
    count, seed = wish.get("count", 50), wish.get("seed", 0)
    if not isinstance(what, list) or not what or not set(what) <= set(PARTS):
        raise Wrong(f"what is a list of {', '.join(PARTS)}")
    if format not in FORMATS:
        raise Wrong(f"format is one of {', '.join(FORMATS)}")
    if type(count) is not int or not 1 <= count <= MOST_SAMPLES or type(seed) is not int or seed < 0:
        raise Wrong(f"count lies between 1 and {MOST_SAMPLES}, seed is a whole number")
    return {"what": what, "format": format, "count": count, "seed": seed}


def one_of(given: Any, name: str, known: Sequence[str]) -> Any:
    """The entry of this name, one of several words."""
    found = mapping(given).get(name)
    if found not in known:
        raise Wrong(f"{name} is one of {', '.join(known)}")
    return found


def number(text: str | None, default: float, low: float, high: float) -> float:
    """A number of a query string, inside its limits."""
    try:
        found = default if text is None else float(text)
    except ValueError as error:
        raise Wrong(f"{text!r} is no number") from error
    if not low <= found <= high:
        raise Wrong(f"{found:g} does not lie between {low:g} and {high:g}")
    return found


def mapping(given: Any) -> dict[str, Any]:
    if not isinstance(given, dict):
        raise Wrong("send a JSON object")
    return given

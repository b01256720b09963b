"""What procedures are written with here: solids, derivations of grammars, sketches."""

from __future__ import annotations

from typing import Any

from shapewright.shapes.conversion.naming import refusal


def convert(value: Any) -> Any:
    """The mesh or the drawing that it makes."""
    for maker in ("mesh", "drawing"):
        if callable(make := getattr(value, maker, None)):
            return make()
    raise refusal(value)

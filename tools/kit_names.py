"""The names of the kit for the completion in the page's editor: ``python tools/kit_names.py``."""

from __future__ import annotations

import inspect
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import shapewright
from shapewright.modelling import drawing, solids

_MODULES = (shapewright, solids, drawing)
_CLASSES = (solids.Solid, drawing.Sketch)


def text() -> str:
    """Each name, where it is, how it is called (empty for what is no function), and what it does."""
    return json.dumps([*_of_modules(), *_of_shapes()], indent=2, ensure_ascii=False) + "\n"


def _of_modules() -> Iterator[dict[str, str]]:
    for module in _MODULES:
        for name in sorted(module.__all__):
            yield _entry(name, module.__name__, getattr(module, name))


def _of_shapes() -> Iterator[dict[str, str]]:
    for shape in _CLASSES:
        for name, value in sorted(vars(shape).items()):
            if not name.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                yield _entry(name, shape.__name__, value)


def _entry(name: str, of: str, value: Any) -> dict[str, str]:
    known = inspect.isfunction(value) or inspect.isclass(value)
    says = (inspect.getdoc(value) or "").partition("\n")[0] if known or isinstance(value, property) else ""
    return {"name": name, "of": of, "call": _call(value) if inspect.isfunction(value) else "", "says": says}


def _call(function: Any) -> str:
    """The names of its arguments; those that may be left out with a question mark."""
    given = [one for one in inspect.signature(function).parameters.values() if one.name != "self"]
    return f"({', '.join(one.name + ('' if one.default is one.empty else '?') for one in given)})"


def main() -> None:
    """Write them."""
    path = Path(__file__).parents[1] / "studio-page" / "src" / "loop" / "kit.json"
    path.write_text(text(), encoding="utf-8", newline="\n")
    sys.stdout.write(f"{path.relative_to(Path(__file__).parents[1])}\n")


if __name__ == "__main__":
    main()

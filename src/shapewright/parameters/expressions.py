"""Conditions that are written as text in files that are no Python: ``style == 'drawer' and shelves > 0``."""

from __future__ import annotations

import ast
import functools
from collections.abc import Mapping
from dataclasses import dataclass
from types import CodeType
from typing import Any

_WORDS = {"true": True, "false": False}
_PARTS = (
    (ast.Expression, ast.Name, ast.Load, ast.Attribute, ast.Constant, ast.Tuple, ast.List),
    (ast.BoolOp, ast.And, ast.Or, ast.UnaryOp, ast.Not, ast.USub, ast.Compare, ast.cmpop),
    (ast.BinOp, ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Mod),
)


@dataclass(frozen=True)
class Expression:
    """A condition of parameters: comparisons, sums and products of names and plain values, joined by and, or, not.

    Attributes:
        text: the condition, in the words of Python; true and false may be written small.

    Raises ValueError where the text is no such condition.
    """

    text: str

    def __post_init__(self) -> None:
        try:
            tree = ast.parse(self.text.strip(), mode="eval")
        except SyntaxError as error:
            raise ValueError(f"{self.text!r} is no condition: {error.msg}") from error
        for part in ast.walk(tree):
            hidden = isinstance(part, ast.Attribute) and part.attr.startswith("_")
            if hidden or not isinstance(part, _PARTS):
                kind = type(part).__name__.lower()
                raise ValueError(
                    f"{self.text!r}: a condition compares parameters and values; {kind} has no place in it"
                )

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that it is about."""
        found = [part.id for part in ast.walk(ast.parse(self.text.strip(), mode="eval")) if isinstance(part, ast.Name)]
        return tuple(name for name in dict.fromkeys(found) if name not in _WORDS)

    def __call__(self, values: Any) -> bool:
        """Whether it holds. values: a mapping, or an object with the parameters as attributes."""
        known = values if isinstance(values, Mapping) else vars(values)
        return bool(eval(_compiled(self.text), {"__builtins__": {}}, {**_WORDS, **known}))


@functools.lru_cache(maxsize=1000)
def _compiled(text: str) -> CodeType:
    return compile(text.strip(), "<condition>", "eval")

"""A rule: a function that makes a part which fills a box, with parameters of its own, and how such parts stand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from shapewright.modelling.solids import Solid, Vector
from shapewright.parameters import ParameterSpace
from shapewright.procedures.signature import signature_of

Stance = Literal["under", "on", "beside", "front", "back", "within", "around", "body", "anywhere"]
"""Where a part stands in a shape: it carries the rest, stands on it, sticks out at a side, in front or at the back,
lies inside, reaches round it, is the body itself, or stands anywhere."""


@dataclass(frozen=True, eq=False)
class Rule:
    """A part that fills a box.

    Attributes:
        function: makes it of a size (width, height, depth), about the origin, and of its parameters.
        space: its parameters.
        stance: where such a part stands.
        turns: in how many ways it may be turned about y by quarter turns: 1, 2 or 4.
    """

    function: Callable[..., Solid]
    space: ParameterSpace
    stance: Stance
    turns: int

    @property
    def name(self) -> str:
        return self.function.__name__

    @property
    def noun(self) -> str:
        """What an author calls the part: ``ring handle``."""
        return self.name.replace("_", " ")

    def __call__(self, size: Vector, **arguments: Any) -> Solid:
        return self.function(size, **arguments)


def rule(stance: Stance, turns: Literal[1, 2, 4] = 1) -> Callable[[Callable[..., Solid]], Rule]:
    """Make a function a rule: ``@rule("beside", turns=4)``.

    Its first parameter is ``size``, (width, height, depth), which the part fills, about the origin. The others have
    Ranges as those of a procedure. Raises ProcedureError when they have none.
    """

    def made(function: Callable[..., Solid]) -> Rule:
        return Rule(function, signature_of(function, skip=1).space, stance, turns)

    return made

"""Random shapes of a procedure without and with a change: whether they stay sound, and where its part stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from shapewright.building import Workers
from shapewright.comparison.surfaces import area
from shapewright.feedback.parts.attachment import separate
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.feedback.trials.attempt import same
from shapewright.feedback.writing.piece_code import quoted
from shapewright.parameters import Binary, Choice, Parameters, ParameterSpace, Value
from shapewright.shapes import Mesh

_DRAWN = 16  # shapes: some for each value of a choice
# By eye, on suggestions for vessels and buildings: walls and roofs show .6 and more, what is buried .2 and less.
_SEEN = 0.3  # of the surface that a part has alone, that is seen where it stands, at least
_POINTS = 1000  # of a shape's surface that tell how much is seen
_FEWEST, _SELDOM = 3, 0.34  # shapes with a value, and how often a part stands in them where it does not belong


@dataclass(frozen=True, eq=False)
class RandomShapes:
    """Shapes of a procedure.

    Attributes:
        space: of the procedure.
        parameters: of each shape.
        shapes: None where none could be built.
        added: what a change adds to each, alone; None where that is no part, or could not be built.
    """

    space: ParameterSpace
    parameters: tuple[Parameters, ...]
    shapes: tuple[Mesh | None, ...]
    added: tuple[Mesh | None, ...] = (None,) * _DRAWN

    @classmethod
    def of(cls, crew: Workers, seed: int) -> RandomShapes:
        space = crew.procedure.space
        drawn = tuple(space.sample(_DRAWN, seed))
        return cls(space, drawn, _built(crew, drawn))

    def changed(self, crew: Workers, flag: str | None) -> RandomShapes:
        """The same parameters in a changed procedure.

        flag: the binary that switches the change on, None where it is always on.
        """
        space = crew.procedure.space
        own = [space.carry(values) for values in self.parameters]
        on = {flag: not space.defaults[flag]} if flag else {}
        drawn = tuple(space.canonical({**values, **on}) for values in own)
        return RandomShapes(space, drawn, _built(crew, drawn))

    def adding(self, crew: Workers) -> RandomShapes:
        """The same with what is added. crew: of a procedure that makes this alone, of the same parameters."""
        return replace(self, added=_built(crew, self.parameters))

    @cached_property
    def unsound(self) -> int:
        return sum(not (shape and shape.soundness().sound) for shape in self.shapes)

    @cached_property
    def pieces(self) -> list[int]:
        """Into how many pieces each shape falls."""
        return [separate(shape) if shape else 0 for shape in self.shapes]

    def branch(self, changed: RandomShapes, helped: Sequence[Parameters]) -> str | None:
        """The condition on parameters ``p`` under which what a change adds stands: None where it stands everywhere.

        It stands where it is seen and where no more floats than before. helped: parameters that make use of it.
        """
        stands = [self._stands(changed, row) for row in range(len(self.shapes))]
        best, most = None, 0
        for parameter in self.space:
            if not isinstance(parameter, Choice | Binary):
                continue
            values = parameter.options if isinstance(parameter, Choice) else (False, True)
            rows = {value: self._rows(parameter.name, value) for value in values}
            out = [v for v in values if len(rows[v]) >= _FEWEST and np.mean([stands[r] for r in rows[v]]) < _SELDOM]
            saved = sum(not stands[row] for value in out for row in rows[value])
            if saved > most and not {own[parameter.name] for own in helped} & set(out):
                best, most = _condition(parameter, [value for value in values if value not in out]), saved
        return best

    def _stands(self, changed: RandomShapes, row: int) -> bool:
        old, new = self.shapes[row], changed.shapes[row]
        if new is None:
            return old is None
        return old is None or (changed.pieces[row] <= self.pieces[row] and shows(old, new, changed.added[row]))

    def _rows(self, name: str, value: Value) -> list[int]:
        return [
            row
            for row, values in enumerate(self.parameters)
            if values[name] == value and name in self.space.active(values)
        ]


def shown(whole: Mesh, part: Mesh) -> float:
    """The share of a part's surface that is still seen where it stands in a whole, by its labels.

    part: without the rest, since parts that are joined keep no surface inside.
    """
    if whole.face_labels is None:
        return 0.0
    labels = [whole.label_names.index(name) for name in part.label_names if name in whole.label_names]
    there, alone = (VisibleSurface.of(mesh.normalised(), _POINTS) for mesh in (whole, part))
    own = there.visible & np.isin(whole.face_labels[there.faces], labels)
    return area(whole) * float(own.mean()) / (area(part) * float(alone.visible.mean()))


def shows(old: Mesh, new: Mesh, added: Mesh | None) -> bool:
    """Whether what a change adds is not hidden in what was there before; where it adds no part, whether it changes."""
    return shown(new, added) >= _SEEN if added else not same(old, new)


def _built(crew: Workers, drawn: Sequence[Parameters]) -> tuple[Mesh | None, ...]:
    return tuple(build.shape if isinstance(build.shape, Mesh) else None for build in crew.build(drawn))


def _condition(parameter: Choice | Binary, kept: Sequence[Value]) -> str:
    name = f"p.{parameter.name}"
    if isinstance(parameter, Binary):
        return name if kept[0] else f"not {name}"
    options = [quoted(value) if isinstance(value, str) else repr(value) for value in kept]
    return f"{name} == {options[0]}" if len(options) == 1 else f"{name} in ({', '.join(options)})"

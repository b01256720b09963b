"""What a fit knows of its references before it learns: from an earlier iteration, or from the first samples."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from shapewright.building import Build
from shapewright.parameters import Parameters, ParameterSpace, Scalar
from shapewright.prediction.dataset import Dataset
from shapewright.prediction.lookup import nearest
from shapewright.prediction.predictor import Predictor
from shapewright.procedures import Procedure
from shapewright.progress import Notice
from shapewright.references import Collection
from shapewright.rendering.raster import render
from shapewright.runs.iteration import Iteration
from shapewright.shapes import Drawing, extent_of
from shapewright.shapes.shelf import fresh

_FEWEST = 3
"""References that tell whether sizes could count: one has a size of the procedure's by chance."""
_VARIED = 1.1
"""Longest side of the largest of them beside the least: those that somebody has normalised are of nearly one size."""
_AT_ONCE = 512
"""References whose pictures are in memory at the same time."""
_WRITTEN = {
    ".scad": "write // shapewright: size=given into the file",
    ".toml": 'write size = "given" into the file',
    ".blend": "write size=given into the file's text shapewright",
}
_IN_PYTHON = 'write size="given" beside unit= in @procedure'


def for_procedure(references: Collection, procedure: Procedure) -> Collection:
    """The references as the procedure's facts have them.

    They stand in its axes, where nobody says which theirs are. Where sizes count they know those of their replicas.
    """
    facts = procedure.facts
    references = references if facts.up == "y" else references.standing(facts.up)
    return references.sized(facts.metres) if facts.size == "given" else references


def as_large(references: Collection, builds: Sequence[Build], procedure: Procedure) -> Notice | None:
    """That sizes could count: the procedure has a unit, and makes shapes as large as each of the references.

    Where only proportions count, lengths that all grow together cannot be told apart.
    """
    facts = procedure.facts
    if facts.size == "given" or facts.unit is None or references.kind is Drawing or references.in_views:
        return None
    made = [extent_of(build.shape) for build in builds if build.shape is not None]
    asked = [extent for extent in references.sized(facts.metres).extents if extent is not None]
    if len(asked) < _FEWEST or not made or max(asked) < _VARIED * min(asked):
        return None
    if min(asked) < min(made) or max(asked) > max(made):
        return None
    how = _WRITTEN.get(procedure.path.suffix if procedure.path else "", _IN_PYTHON)
    sizes = f"{min(asked):.3g} to {max(asked):.3g} {facts.unit}"
    return Notice(
        "size", f"the references are as large as what the procedure builds, {sizes}: {how} to find lengths too"
    )


@dataclass(frozen=True, eq=False)
class Start:
    """Where a fit starts; ``new`` has scalars alone, since all likely values of other kinds are tried anyway."""

    references: Collection  # those to fit
    resumed: bool  # whether there is an earlier iteration
    known: tuple[Parameters | None, ...]  # found by it for each reference, in the present space; None for a new one
    predictor: Predictor | None  # the one that it trained
    new: frozenset[str] | None  # scalars that it did not have, or not in this Range; None where it did not search
    others: tuple[tuple[Parameters, ...], ...] = ()  # for each reference parameters worth a trial too

    @classmethod
    def of(
        cls,
        references: Collection,
        space: ParameterSpace,
        previous: Iteration | None,
        known: Mapping[str, Sequence[Parameters]] | None = None,
    ) -> Start:
        """Without an earlier iteration nothing is known but ``known``: parameters by the name of their reference."""
        others = tuple(tuple(map(space.carry, (known or {}).get(name, ()))) for name in references.names)
        return replace(cls._resumed(references, space, previous), others=others)

    @classmethod
    def _resumed(cls, references: Collection, space: ParameterSpace, previous: Iteration | None) -> Start:
        if previous is None:
            return cls(references, False, (None,) * len(references), None, None)
        old = {result.name: result.parameters for result in previous}
        known = tuple(space.carry(values) if (values := old.get(name)) else None for name in references.names)
        new = None
        if previous.predictor and previous.settings.refine != "off":
            before = previous.predictor.space.parameters
            new = frozenset(p.name for p in space if isinstance(p, Scalar) and p not in before)
        return cls(references, True, known, previous.predictor, new)

    @property
    def answer(self) -> dict[str, Parameters]:
        """The known parameters, by the names of their references."""
        return {name: values for name, values in zip(self.references.names, self.known, strict=True) if values}

    def most_similar(self, samples: Dataset, threads: int | None) -> dict[str, Parameters]:
        """The parameters of the sample that looks most like each reference."""
        rows: list[int] = []
        for start in range(0, len(self.references), _AT_ONCE):
            shapes = [fresh(reference.shape) for reference in self.references.references[start : start + _AT_ONCE]]
            pictures = render(shapes, samples.cameras, samples.size, threads=threads)
            rows += nearest(pictures, samples.images).tolist()
        return {name: samples.parameters[row] for name, row in zip(self.references.names, rows, strict=True)}

"""Parts that stand in the reference as they could in a replica, but lean: no search among upright parts finds them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shapewright.building import Workers
from shapewright.feedback.parts.supports import supports, with_splayed
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.search.candidates import others
from shapewright.shapes import Mesh
from shapewright.threads import in_threads

_FACTORS = (0.2, 0.4, 0.7, 1.4, 1.8)
"""Of the width at the floor. These and _FINER were chosen on seeds 1 and 2 of ``benchmarks/causes.py``."""
_FINER = (0.6, 0.8, 1.25)  # of the best factor
_OTHERWISE = (0.4, 0.6, 0.8, 1.25, 1.6, 2.2)  # of the one factor, what the other may be
_SHAPES = 600  # built for all references together, at most about


@dataclass(frozen=True)
class Leaning:
    """A part that leans."""

    label: str  # of the part
    factor: float  # width of its foot, in units of its head's
    deeper: float  # the same from front to back
    apart: float  # how much of the surfaces lies apart then, see ``placement.Overlay``


def leaning(
    crew: Workers,
    standing: Sequence[tuple[Parameters, Overlay]],
    threads: int | None = None,
    known: Sequence[Mesh] = (),
) -> list[Leaning | None]:
    """For each reference the part whose leaning leaves least of the surfaces apart; None where nothing stands.

    standing: the parameters of each reference's replica, and the reference's overlay. known: another replica of each.
    Parts are those of the replicas, and of shapes with one other choice: where parts that lean are not recognised, the
    replica may well stand on others. They are tried with all numbers away from the ends of their Ranges, too: parts
    that cannot lean become thin.
    """
    space, most = crew.procedure.space, max(1, _SHAPES // max(len(standing), 1))
    asked: list[tuple[int, Parameters]] = []
    for i, (parameters, _) in enumerate(standing):
        centre = space.encode(parameters)
        thicker = space.encode(_unpressed(space, parameters))
        vectors = space.distinct([centre, thicker, *others(space, centre)])[:most]
        asked += [(i, space.canonical(space.decode(vector))) for vector in vectors]
    meshes: list[list[Mesh]] = [[mesh] for mesh in known] or [[] for _ in standing]
    for (i, _), build in zip(asked, crew.build([values for _, values in asked]), strict=True):
        if isinstance(build.shape, Mesh):
            meshes[i].append(build.shape)

    def lean(i: int, mesh: Mesh, label: str, factor: float, deeper: float | None = None) -> Leaning:
        factors = factor, factor if deeper is None else deeper
        return Leaning(label, *factors, standing[i][1](with_splayed(mesh, label, *factors)))

    def best(i: int) -> Leaning | None:
        upright = [(mesh, label) for mesh in meshes[i] for label in supports(mesh)]
        coarse = [(lean(i, *part, factor), part) for part in upright for factor in _FACTORS]
        if not coarse:
            return None
        least, part = min(coarse, key=lambda candidate: candidate[0].apart)
        nearby = [lean(i, *part, least.factor * finer) for finer in _FINER]
        least = min([least, *nearby], key=lambda candidate: candidate.apart)
        aside = [lean(i, *part, least.factor, least.factor * other) for other in _OTHERWISE]
        aside += [lean(i, *part, least.factor * other, least.factor) for other in _OTHERWISE]
        return min([least, *aside], key=lambda candidate: candidate.apart)

    return in_threads(best, range(len(standing)), threads)


def _unpressed(space: ParameterSpace, parameters: Parameters) -> Parameters:
    """The parameters with every number that rests on an end of its Range at its default."""
    return {**parameters, **{name: space[name].default for name, _ in space.pressed(parameters)}}

"""Parts that stand in the reference as they could in a replica, but lean: no search among upright parts finds them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shapewright.building import Workers
from shapewright.feedback.parts.supports import supports, with_splayed
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.search.combinations import others
from shapewright.shapes import Mesh
from shapewright.threads import in_threads

_FACTORS, _FINER = (0.2, 0.4, 0.7, 1.4, 1.8), (0.6, 0.8, 1.25)
_SHAPES = 600  # built for all references together, at most about


@dataclass(frozen=True)
class Leaning:
    """label: of the part. factor: how far apart its foot stands, in units of its head. apart: how much of the surfaces
    lies apart then, see ``placement.Overlay``.
    """

    label: str
    factor: float
    apart: float


def leaning(
    space: ParameterSpace,
    crew: Workers,
    found: Sequence[Parameters],
    overlays: Sequence[Overlay],
    threads: int | None = None,
) -> list[Leaning | None]:
    """For each reference the part whose leaning leaves least of the surfaces apart; None where nothing stands.

    Parts are those of the shapes with the parameters found, and with one other choice: where the parts that lean were
    not recognised, what was found may well stand on others. overlays: of the references.
    """
    encoded, each = [space.encode(parameters) for parameters in found], max(1, _SHAPES // max(len(found), 1))
    vectors = [[centre, *others(space, centre)][:each] for centre in encoded]
    asked = [(i, space.canonical(space.decode(vector))) for i, several in enumerate(vectors) for vector in several]
    meshes: list[list[Mesh]] = [[] for _ in found]
    for (i, _), build in zip(asked, crew.build([values for _, values in asked]), strict=True):
        if isinstance(build.shape, Mesh):
            meshes[i].append(build.shape)

    def lean(i: int, mesh: Mesh, label: str, factor: float) -> Leaning:
        return Leaning(label, factor, overlays[i](with_splayed(mesh, label, factor)))

    def best(i: int) -> Leaning | None:
        upright = [(mesh, label) for mesh in meshes[i] for label in supports(mesh)]
        tried = [(lean(i, *part, factor), part) for part in upright for factor in _FACTORS]
        if not tried:
            return None
        least, part = min(tried, key=lambda each: each[0].apart)
        nearby = [lean(i, *part, least.factor * finer) for finer in _FINER]
        return min([least, *nearby], key=lambda each: each.apart)

    return in_threads(best, range(len(found)), threads)

"""A 3MF package, read into the triangles of what it builds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.scene_parts import Scene, join, placed, refuse_too_many
from shapewright.references.readers.threemf.model import Model, Object, Use, read_model
from shapewright.references.readers.threemf.package import Package, part_key, unpack
from shapewright.shapes import Floats

_DEEPEST = 100
"""Levels of components. Real packages have one to three."""
_LASTING = ("model", "surface")
"""Types of objects that are there when all is made; the others support them until then."""
_MOST = 200_000
"""Places of objects. A small package can announce any number, since an object may be a component of many."""
_SHOWN = 60
_MILLIMETRE = 1e-3  # in metres
_Key = tuple[str, int]
_Models = Callable[[str], Model]


class _Place(NamedTuple):
    """An object, by the key of its part and its number in it, and where it stands (4, 4)."""

    part: str
    number: int
    matrix: Floats
    above: str = ""  # name of the nearest object that holds it and has one

    def called(self, thing: Object) -> PartName:
        """What the object here is called."""
        return PartName(PartName.of(thing.name).name or self.above, PartName.of(thing.material).name)


class _Size(NamedTuple):
    """How many triangles an object has with all its components, and in how many places they stand."""

    triangles: int
    places: int


def read_3mf(path: Path, data: bytes) -> Scene:
    """The triangles of a 3MF file's bytes, Z up, in the unit of its build.

    Objects stand where build items and components place them, in any part of the package. What only supports them is
    left out. Parts have the names of their objects, or of the next ones that hold them. Raises UnreadableError, with
    the reason.
    """
    del path  # a package refers to nothing beside it
    package = unpack(data)
    models = _models(package)
    root = part_key(package.root)
    places = [_target(models, item, _Place(root, 0, np.eye(4))) for item in models(root).items]
    if not places:
        raise UnreadableError("nothing is to be built: its build section is empty or missing")
    sizes: dict[_Key, _Size] = {}
    counts = [_size(models, place, sizes, ()) for place in places]
    refuse_too_many(sum(count.triangles for count in counts))
    if sum(count.places for count in counts) > _MOST:
        raise UnreadableError(f"its objects stand in more than {_MOST:,} places")
    found = [part for place in places for part in _spread(models, place)]
    shown = [(place, thing) for place, thing in found if thing.kind in _LASTING]
    for _, thing in shown:
        _refuse_other_forms(thing)
    vertices, faces = join([placed(thing.vertices, thing.faces, place.matrix) for place, thing in shown])
    beams = sum(thing.has_beams for _, thing in shown)
    if beams and not len(faces):
        raise UnreadableError("no triangles, only beams, which are not read")
    notes = [f"{beams} x lattice of beams left out"] if beams else []
    kinds = Counter(thing.kind for _, thing in found if thing.kind not in _LASTING)
    notes += [f"{count} x object of the type {kind[:_SHOWN]!r} left out" for kind, count in kinds.items()]
    others = Counter(what for _, thing in shown for what in thing.others)
    notes += [f"{count} x {what} passed over" for what, count in others.items()]
    unit = models(root).unit * _MILLIMETRE
    parts = Parts.of((place.called(thing), len(thing.faces)) for place, thing in shown)
    return Scene(vertices, faces, (*package.notes, *notes), unit, up="z", parts=parts)


def _models(package: Package) -> _Models:
    """What reads the parts of a package, each once."""

    @cache
    def model(part: str) -> Model:
        try:
            return read_model(package.read(part))
        except UnreadableError as error:
            raise UnreadableError(f"{error} (part {part[:200]})") from error

    return model


def _find(models: _Models, place: _Place) -> Object:
    found = models(place.part).objects.get(place.number)
    if found is None:
        raise UnreadableError(f"broken: it refers to object {place.number} of {place.part}, which is not there")
    return found


def _target(models: _Models, use: Use, user: _Place) -> _Place:
    """Where an item, or a component of an object that stands somewhere, puts its object; parts may differ in units."""
    part = user.part if use.path is None else part_key(use.path)
    matrix = use.matrix.copy()
    matrix[:3, :3] *= models(part).unit / models(user.part).unit
    return _Place(part, use.number, user.matrix @ matrix)


def _size(models: _Models, place: _Place, sizes: dict[_Key, _Size], above: Sequence[_Key]) -> _Size:
    """How much an object and all its components are; kept in ``sizes``."""
    key = place[:2]
    if key in above or len(above) > _DEEPEST:
        deep = "is a component of itself" if key in above else f"has more than {_DEEPEST} levels of components"
        raise UnreadableError(f"broken: object {place.number} of {place.part} {deep}")
    if key not in sizes:
        thing = _find(models, place)
        below = [_size(models, _target(models, part, place), sizes, (*above, key)) for part in thing.parts]
        triangles = len(thing.faces) + sum(each.triangles for each in below)
        sizes[key] = _Size(triangles, 1 + sum(each.places for each in below))
    return sizes[key]


def _spread(models: _Models, place: _Place) -> Iterator[tuple[_Place, Object]]:
    """An object and all its components, where they stand; nothing below one that does not last."""
    thing = _find(models, place)
    yield place, thing
    if thing.kind in _LASTING:
        name = place.called(thing).name
        for part in thing.parts:
            yield from _spread(models, _target(models, part, place)._replace(above=name))


def _refuse_other_forms(thing: Object) -> None:
    if thing.is_sketch:
        raise UnreadableError("it has slices, of which its mesh is only a sketch (the slice extension)")
    if thing.others and not len(thing.faces) and not thing.parts:
        raise UnreadableError(f"an object is {' and '.join(thing.others)}, which is not read")

"""Parts that a shape stands on: which they are, and their form when they lean."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from shapewright.feedback.surfaces.connection import connected
from shapewright.shapes import Floats, Mesh, concatenate

_FLOOR, _TALL = 0.05, 0.15  # of the largest extent: how low a part that may lean begins, and how tall it is at least


def supports(replica: Mesh) -> tuple[str, ...]:
    """Labels of the parts that stand on the floor, and are more than feet: those that may lean."""
    labels = []
    for label in replica.label_names:
        if (bounds := bounds_of(replica, label)) is not None:
            low, high = (bounds[:, 1] - replica.bounds[0, 1]) / replica.extent.max()
            labels += [label] if low < _FLOOR and high - low > _TALL else []
    return tuple(labels)


def splayed(part: Mesh, factors: Floats) -> Mesh:
    """A part as wide as it is at its high end, by the factors at the low one, and evenly between."""
    low, high = part.bounds
    down = (high[1] - part.vertices[:, 1:2]) / max(high[1] - low[1], 1e-9)
    middle = (low + high) / 2.0
    return Mesh((part.vertices - middle) * (1.0 + (factors - 1.0) * np.clip(down, 0.0, 1.0)) + middle, part.faces)


def with_splayed(replica: Mesh, label: str, factor: float, deeper: float) -> Mesh:
    """A replica with one labelled part splayed by the factors from left to right and from front to back, as a soup.

    Each connected piece of it leans as a whole: it stays as thick as it is.
    """
    rest, part, aside = _taken_out(replica, label)
    low, high = part.bounds
    down = (high[1] - part.vertices[:, 1:2]) / max(high[1] - low[1], 1e-9)
    leaning = Mesh(part.vertices + down * aside * [factor - 1.0, 0.0, deeper - 1.0], part.faces)
    return concatenate([rest, leaning]) if len(rest.faces) else leaning


@lru_cache(maxsize=16)  # a part is splayed many times
def _taken_out(replica: Mesh, label: str) -> tuple[Mesh, Mesh, Floats]:
    """A replica without a part, the part, and how far each of its corners' pieces stands from its middle, (V, 3)."""
    assert replica.face_labels is not None
    of_part = replica.face_labels == replica.label_names.index(label)
    rest = Mesh(replica.vertices, replica.faces[~of_part])
    used, faces = np.unique(replica.faces[of_part], return_inverse=True)
    part = Mesh(replica.vertices[used], faces.reshape(-1, 3))
    _, welded = np.unique(np.round(part.vertices, 6), axis=0, return_inverse=True)
    corners = welded.reshape(-1)
    joined = corners[part.faces]
    count, component = connected(int(joined.max()) + 1, joined[:, :2].ravel(), joined[:, 1:].ravel())
    middles = np.empty((count, 3))
    for number in range(count):
        places = part.vertices[component[corners] == number]
        middles[number] = (places.min(axis=0) + places.max(axis=0)) / 2.0
    return rest, part, middles[component[corners]] - part.bounds.mean(axis=0)


def bounds_of(replica: Mesh, label: str) -> Floats | None:
    """The bounding box (2, 3) of a part, None where none of its faces are left."""
    if replica.face_labels is None:
        return None
    faces = replica.faces[replica.face_labels == replica.label_names.index(label)]
    return Mesh(replica.vertices, faces).bounds if len(faces) else None

"""Groups of shapes that look alike, from the distances between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.settings import Settings
from shapewright.shapes import Floats

CUT = Settings.cut
"""Share of the largest distance up to which groups are merged (paper section 4.3)."""


@dataclass(frozen=True)
class Group:
    """Names of shapes that look alike.

    representative: the member with the least mean distance to the others.
    members: all of them, the nearest to the others first.
    """

    representative: str
    members: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.members)


def group(names: Sequence[str], distances: Floats, cut: float = CUT, absolute: bool = False) -> tuple[Group, ...]:
    """Agglomerative clustering with complete linkage (paper section 4.3), the largest group first.

    distances: (N, N), symmetric. Groups are merged while no two members are further apart than ``cut`` times the
    largest distance present; or than ``cut`` itself when ``absolute`` (the paper's code: 3400 / 15000).
    The representative is the member with the least mean distance to the others.
    """
    if len(names) < 2:
        return tuple(Group(name, (name,)) for name in names)
    from sklearn.cluster import AgglomerativeClustering  # slow to import, and the studio's bench does not need it

    limit = cut if absolute else cut * float(distances.max())
    linkage = AgglomerativeClustering(
        n_clusters=None,
        metric="precomputed",
        linkage="complete",
        distance_threshold=float(np.nextafter(limit, np.inf)),
    )
    labels = linkage.fit_predict(distances)
    groups = []
    for label in np.unique(labels):
        rows = np.flatnonzero(labels == label)
        inward = distances[np.ix_(rows, rows)].mean(axis=1)
        order = rows[np.lexsort((rows, inward))]
        groups.append(Group(names[order[0]], tuple(names[i] for i in order)))
    return tuple(sorted(groups, key=lambda g: (-len(g), g.representative)))

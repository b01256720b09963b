"""How a shape may stand: turned by quarter turns, on its head, mirrored; and how well two agree in each pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.building import Workers
from shapewright.feedback.case import Case, Cause
from shapewright.prediction.predictor import Predictor
from shapewright.references.orientation import QUARTER_TURNS
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Floats, Mesh
from shapewright.threads import in_threads

_CLEARLY = 0.9
"""Of what lies apart as given, that another pose leaves at most. Chosen on benchmarks/poses.py, as the next two."""
_ENOUGH = 0.05  # by which it has to lower that: a shelf on its head differs by less from one that stands
_ALIKE = 1.1  # of the least that any pose leaves: of poses that are as good, the first one is told
_PICTURE = 128  # pixels along the side of what a cause shows
_SIZE = 64  # pixels along the side of a picture
_VIEWS = tuple(
    Camera(azimuth, elevation)
    for azimuth, elevation in ((35, 25), (125, 25), (215, 25), (305, 25), (0, 0), (90, 0), (80, -25), (260, -25))
)
"""From all sides: views from the front alone do not tell a chair from one that looks away."""


@dataclass(frozen=True)
class Pose:
    """A way to stand. First a shape is mirrored (left for right), then laid on its head, then turned."""

    quarters: int = 0  # turns about the up axis, 0 to 3, from the front towards the right
    on_its_head: bool = False  # turned over about the axis that runs to the front
    mirrored: bool = False

    @property
    def matrix(self) -> Floats:
        """(3, 3): takes a shape to this pose."""
        over = np.diag([-1.0, -1.0, 1.0]) if self.on_its_head else np.eye(3)
        other = np.diag([-1.0, 1.0, 1.0]) if self.mirrored else np.eye(3)
        return np.asarray(QUARTER_TURNS[self.quarters] @ over @ other)

    def of(self, mesh: Mesh) -> Mesh:
        """The mesh in this pose."""
        faces = mesh.faces[:, ::-1] if self.mirrored else mesh.faces
        return Mesh(mesh.vertices @ self.matrix.T, faces)


AS_GIVEN = Pose()
OTHERS = (
    *(Pose(quarters) for quarters in (1, 2, 3)),
    *(Pose(quarters, on_its_head=True) for quarters in range(4)),
    Pose(mirrored=True),
)
"""The other poses that are tried. A mirrored one is not turned: collections hold left and right pieces, seldom more."""


@dataclass(frozen=True, eq=False)
class Depths:
    """A normalised mesh in pictures from all sides."""

    pictures: Floats  # (8, 64, 64), nearness from 0 to 1; 0 where there is nothing

    @classmethod
    def of(cls, mesh: Mesh) -> Depths:
        drawn = render([mesh.normalised()], _VIEWS, _SIZE, supersample=1, threads=1)[0, :, 1]
        return cls(drawn / 255.0)

    def apart(self, other: Depths) -> float:
        """Mean difference where either is, 0 to 1; what only one of the two covers counts whole."""
        either = np.maximum(self.pictures, other.pictures) > 0.0
        both = np.minimum(self.pictures, other.pictures) > 0.0
        gaps = np.where(both, np.abs(self.pictures - other.pictures), either)
        return float(gaps.sum() / max(either.sum(), 1))


@dataclass(frozen=True)
class Standing:
    """How a reference stands, as replicas have it."""

    pose: Pose  # in which the reference fits best
    before: float  # what lies apart as it was given, 0 to 1
    after: float  # and in that pose

    @property
    def told(self) -> bool:
        """Not where the reference fits about as well as it was given."""
        return self.after <= min(_CLEARLY * self.before, self.before - _ENOUGH)

    def cause(self, reference: Mesh) -> Cause:
        """With a picture of the reference in that pose."""
        pose = self.pose
        evidence = {
            "turned": 90 * pose.quarters,
            "on_its_head": pose.on_its_head,
            "mirrored": pose.mirrored,
            "before": round(self.before, 4),
            "after": round(self.after, 4),
            "words": _told(pose),
        }
        text = f"{_told(pose)}; {self.after / self.before:.0%} of what lies apart is left"
        return Cause("another pose", text, evidence, picture=thumbnail(pose.of(reference), _PICTURE))


def standings(
    cases: Sequence[Case],
    predictor: Predictor | None,
    crew: Workers,
    threads: int | None,
    extents: Sequence[float | None],
) -> list[Standing]:
    """How each reference stands.

    In every pose the replicas that are known are laid over the reference, and the one that is predicted for it in that
    pose; the nearest counts. extents: the longest sides that replicas are to have, where sizes count.
    """
    poses = (AS_GIVEN, *OTHERS)
    stood = [[pose.of(case.reference) for pose in poses] for case in cases]
    sides = [extent for extent in extents for _ in poses]
    guesses = predictor.predict([mesh for row in stood for mesh in row], sides) if predictor else []
    builds = [build.shape for build in crew.build(guesses)] or [None] * (len(poses) * len(cases))

    def standing(i: int) -> Standing:
        known = [replica.mesh for replica in (cases[i].replica, cases[i].nearest, cases[i].covering)]
        pictures = [Depths.of(mesh) for mesh in dict.fromkeys(known)]
        costs = []
        for mesh, guess in zip(stood[i], builds[i * len(poses) :], strict=False):
            here = Depths.of(mesh)
            fresh = [Depths.of(guess)] if isinstance(guess, Mesh) else []
            costs.append(min(here.apart(other) for other in [*pictures, *fresh]))
        best = next(n for n, cost in enumerate(costs) if cost <= _ALIKE * min(costs))
        return Standing(poses[best], costs[0], costs[best])

    return in_threads(standing, range(len(cases)), threads)


def _told(pose: Pose) -> str:
    turned = f"turned by {90 * pose.quarters} degrees"
    if pose.on_its_head:
        also = f" and {turned}" if pose.quarters else ""
        return f"stands on its head: turned over{also} it fits better; turn the file, or say which way is up with --up"
    if pose.mirrored:
        return "is a mirror image: mirrored it fits better; mirror the file, or let the procedure build both sides"
    return f"faces the other way: {turned} it fits better; fit with --facing found, or turn the file"

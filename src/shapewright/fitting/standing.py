"""Up and front of references, found by what the procedure makes; and where up of the two is not the same axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from shapewright.axes.agreement import Z_UP
from shapewright.axes.finding import SAMPLES
from shapewright.axes.turns import TURNS, UPRIGHT
from shapewright.building import Workers
from shapewright.prediction.dataset import Dataset
from shapewright.prediction.lookup import squares
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Notice, Stages
from shapewright.references import Collection
from shapewright.references.standing import AUTO, found_axes, is_free
from shapewright.rendering.raster import render
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings
from shapewright.shapes import Floats, Mesh

_LOOKED_AT, _FEWEST = 8, 3
"""References that tell whether they lie: evenly spread over the collection. A single shelf may
look alike both ways."""
_CLEARLY, _MOSTLY = 0.6, 0.8
"""Shares of what pictures differ by as it is: the median of the references, and three quarters of them. Of a procedure
that builds tables Z up the median is .04 for its own shapes, turned, and .48 for real tables. Where up is the same it
is 1.17 or more for the procedures of the demo and of examples/categories, .82 for chairs that are to be lamps; of
single shelves a fifth are below .6."""

Remedy = Literal["procedure up z", "references up z", "references up y"]
"""What brings up of both to the same axis: a fact of the procedure, or an option of the references."""


@dataclass(frozen=True)
class Lying:
    """References that fit clearly better after a quarter turn that exchanges up and front.

    better: how many of those that were looked at.
    looked_at: number of references.
    remedies: what an author can say, the likelier first.
    """

    better: int
    looked_at: int
    remedies: tuple[Remedy, ...]

    @property
    def notice(self) -> Notice:
        """The same for a person."""
        texts: dict[Remedy, str] = {
            "procedure up z": 'write @procedure(up="z") if z is up in what the procedure builds',
            "references up z": "say --up z if z is up in the files of the references",
            "references up y": "say --up y --front z if y is up in the files of the references",
        }
        text = f"of {self.looked_at} references {self.better} fit clearly better when another axis is up: "
        return Notice("lying", text + ", or ".join(texts[remedy] for remedy in self.remedies))


def stand(
    procedure: Procedure,
    references: Collection,
    settings: Settings | None = None,
    progress: Listener | None = None,
    previous: Iteration | None = None,
) -> Collection:
    """The references as they stand beside shapes of the procedure, where up is "auto"; as they are elsewhere.

    Those that an earlier iteration found keep its axes. It takes seconds where there are others. Raises ProcedureError
    when the procedure cannot build shapes.
    """
    if references.up != AUTO or references.kind is not Mesh:
        return references
    settings, stages = settings or Settings(), Stages(progress)
    recorded = found_axes(previous.collection) if previous else {}
    if all(each.name in recorded for each in references if is_free(each)):
        return references.stood((), settings.workers, recorded)
    vectors = procedure.space.sample(SAMPLES, seed=settings.seed)
    stages.begin("axes", len(vectors))
    with Workers.of(procedure, settings) as crew:
        builds = crew.build(vectors, stages.step, give_up=True)
    taught = [build.shape for build in builds if isinstance(build.shape, Mesh)]
    found = references.stood(taught, settings.workers, recorded)
    stages.end()
    return found


def lying(references: Collection, samples: Dataset, up: str) -> Lying | None:
    """Whether up of the references is another axis than up of the procedure; None where it is not clearly so.

    samples: of the procedure. up: the axis that the procedure says, which its samples were turned by.
    """
    if samples.kind is not Mesh or references.in_views or references.has_points or references.up == AUTO:
        return None
    step = -(-len(references) // _LOOKED_AT)
    some = [reference.shape for reference in tuple(references)[::step] if isinstance(reference.shape, Mesh)]
    if len(some) < _FEWEST:
        return None
    facing, turn = TURNS[UPRIGHT], TURNS[Z_UP]
    before = _unlike(some, samples, facing)
    laid = _unlike(some, samples, turn.T @ facing) / before  # as a procedure that builds Z up and does not say so
    stood = _unlike(some, samples, facing @ turn) / before  # from files that are Z up
    open_ = any(reference.axes_by == "default" for reference in references)
    remedies: list[tuple[float, Remedy]] = []
    if up == "y":
        remedies.append((_clear(laid), "procedure up z"))
    if open_ and up == "y":
        remedies.append((_clear(stood), "references up z"))
    elif open_ and up == "z":
        remedies.append((_clear(laid), "references up y"))
    found = tuple(remedy for share, remedy in remedies if share <= _CLEARLY)
    better = np.minimum(laid, stood) if up == "y" else laid
    return Lying(int((better <= _MOSTLY).sum()), len(some), found) if found else None


def _clear(shares: Floats) -> float:
    """The median, or infinite where it does not stand for most."""
    return float(np.median(shares)) if np.quantile(shares, 0.75) <= _MOSTLY else np.inf


def _unlike(shapes: Sequence[Mesh], samples: Dataset, turns: Floats) -> Floats:
    """By how much the pictures of shapes differ from the nearest sample, (N,), after the best of turns (T, 3, 3)."""
    turned = [shape.transformed(turn) for turn in turns for shape in shapes]
    found = squares(render(turned, samples.cameras, samples.size), samples.images).min(axis=1)
    least: Floats = found.reshape(len(turns), len(shapes)).min(axis=0).astype(float)
    return np.maximum(least, 1e-6)

"""The judge of drawings: pictures instead of light fields."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build
from shapewright.comparison import outline
from shapewright.comparison.grouping import Group, group
from shapewright.comparison.pictures import intersection_over_union, visual_information_fidelity
from shapewright.judging import metric
from shapewright.references import Collection
from shapewright.rendering.ink import coverage
from shapewright.search.search import Measure
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Shape
from shapewright.threads import in_threads

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
SMALL = 64
"""Pixels along the side of the pictures that are compared while searching."""
SCALES = ((12.0, 16), (6.0, 8), (3.0, 4), (1.0, 2))
"""Their blurs, as standard deviations in pixels, and the pixels between the samples that are taken of each."""
UNIT = 56.0
"""What a black pixel counts; sets what the search takes as small."""

ENOUGH = 0.8
"""Black pixels that make no difference: half a percent of a table of thin lines."""


@dataclass(frozen=True, eq=False)
class PictureJudge:
    """Measures replicas against the drawings of one collection, on several threads; what Judge is for meshes.

    outlines: of the references; None for one so thin that no pixel shows it, which nothing can replicate.
    """

    references: Collection
    outlines: tuple[outline.Outline | None, ...]
    settings: Settings
    _targets: dict[int, Floats] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, references: Collection, settings: Settings, cache: Path | None = None) -> PictureJudge:
        """Describe the references, too quickly for a cache to matter."""
        return cls(references, tuple(in_threads(_describe, [r.shape for r in references], settings.workers)), settings)

    @property
    def metric(self) -> metric.Metric:
        return metric.fidelity(self.settings.fidelity)

    def distances(self, builds: Sequence[Build], rows: Sequence[int] | None = None) -> Floats:
        """One less the visual information fidelity of one build for each reference, (N,); NaN where there is none.

        rows: indices of the references that the builds are for, all of them by default.
        """

        def distance(asked: tuple[int, Build]) -> float:
            pair = self._pair(asked[0], asked[1].shape)
            return max(0.0, 1.0 - visual_information_fidelity(*pair)) if pair else np.nan

        asked = zip(range(len(builds)) if rows is None else rows, builds, strict=True)
        return np.array(in_threads(distance, asked, self.settings.workers))

    def nearest(self, builds: Sequence[Build], rows: Sequence[int] | None = None) -> tuple[Floats, Ints]:
        """Distances as above; drawings have one view only, 0."""
        return self.distances(builds, rows), np.zeros(len(builds), dtype=np.int64)

    def measure(self, rows: Sequence[int] | Ints, fields: Sequence[int] | Ints | None = None) -> Measure:
        """What a search for some references goes by; it gets replicas with their references' places among ``rows``.

        The vectors are differences of pictures, blurred at several scales: blurred ones change evenly while an edge
        moves by as much as the blur is wide, sharp ones within a pixel. None where one cannot be seen.
        """

        def residual(asked: tuple[int, Shape]) -> Floats | None:
            row, shape = int(rows[asked[0]]), asked[1]
            return _blurred(shape) - self._target(row) if self._pair(row, shape) else None

        return lambda pairs: in_threads(residual, pairs, self.settings.workers)

    def _target(self, row: int) -> Floats:
        """One reference at every one of the SCALES, made once."""
        if row not in self._targets:
            self._targets[row] = _blurred(self.references.references[row].shape)
        return self._targets[row]

    @property
    def search_parts(self) -> tuple[slice, ...]:
        """Of the residuals, one for each of the SCALES."""
        ends = np.cumsum([0, *((SMALL // step) ** 2 for _, step in SCALES)])
        return tuple(slice(start, end) for start, end in pairwise(ends.tolist()))

    @property
    def search_enough(self) -> float:
        """The cost, at the finest of the scales, at which the overlap is all but whole even where lines are thin."""
        return ENOUGH * UNIT

    @property
    def search_doubt(self) -> float:
        """What it costs a search to choose something unlikely: nothing, forms are told apart by their pictures."""
        return 0.0

    @property
    def goal(self) -> None:
        """The residuals say nothing of which replica is surely compatible."""
        return None

    def overlaps(self, builds: Sequence[Build]) -> tuple[Floats, Floats]:
        """IoU of one build for each reference, and no Chamfer distance; NaN where there is none."""

        def overlap(row: int) -> float:
            pair = self._pair(row, builds[row].shape)
            return intersection_over_union(*pair) if pair else np.nan

        iou = in_threads(overlap, range(len(builds)), self.settings.workers)
        return np.array(iou), np.full(len(builds), np.nan)

    def depths(self, builds: Sequence[Build]) -> Floats:
        """Drawings have no depth: NaN."""
        return np.full(len(builds), np.nan)

    def compatible(self, distances: Floats, iou: Floats, depth: Floats) -> NDArray[np.bool_]:
        """Which replicas are near enough."""
        return np.asarray(distances <= self.metric.threshold)

    def groups(self, compatible: NDArray[np.bool_]) -> tuple[Group, ...]:
        """The references that are not compatible, by the likeness of their outlines."""
        rows = [i for i, d in enumerate(self.outlines) if d and not compatible[i]]
        misfits = [d for i in rows if (d := self.outlines[i])]
        between = outline.distances(misfits, align=self.settings.align)
        names = [self.references.names[i] for i in rows]
        # The absolute cut of the settings is a light-field distance, which has another scale.
        return group(names, between, self.settings.cut)

    def _pair(self, row: int, shape: Shape | None) -> tuple[Drawing, Drawing] | None:
        """The reference and a replica of it, where both can be seen."""
        reference = self.references.references[row].shape
        if self.outlines[row] is None or not isinstance(reference, Drawing) or not isinstance(shape, Drawing):
            return None
        return (reference, shape) if outline.silhouette(shape).any() else None


def _lens(blur: float, step: int) -> Floats:
    """(SMALL / step, SMALL): takes samples of a row of pixels, blurred; times what a sample stands for along it."""
    centres = np.arange(SMALL // step)[:, None] * step + (step - 1) / 2.0
    weights = np.exp(-0.5 * ((np.arange(SMALL) - centres) / blur) ** 2)
    return np.asarray(weights * (step / (blur * math.sqrt(2.0 * math.pi))))


_LENSES = tuple(_lens(*scale) for scale in SCALES)


def _blurred(shape: Shape) -> Floats:
    """(K,): a drawing at every one of the SCALES, in units of UNIT for each pixel of the picture."""
    assert isinstance(shape, Drawing)
    sharp = coverage(shape, SMALL) * UNIT
    return np.concatenate([(lens @ sharp @ lens.T).ravel() for lens in _LENSES])


def _describe(shape: Shape) -> outline.Outline | None:
    try:
        return outline.descriptor(shape) if isinstance(shape, Drawing) else None
    except ValueError:
        return None

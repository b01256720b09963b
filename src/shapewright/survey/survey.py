"""A collection looked at before any procedure exists: what was read, how, and what is odd."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from shapewright.references import Collection, Reference
from shapewright.references.standing import stood
from shapewright.settings import Preparing, Settings
from shapewright.shapes import Drawing, Mesh, Points
from shapewright.storage import printable
from shapewright.survey.duplicates import Duplicate, duplicates
from shapewright.survey.facts import Facts, facts, other_sizes
from shapewright.survey.likeness import pictures
from shapewright.survey.outliers import Outlier, outliers
from shapewright.survey.preparation import prepared
from shapewright.threads import in_threads


@dataclass(frozen=True, eq=False)
class Survey:
    """What is known of a collection.

    Attributes:
        references: those that a fit takes, without what is left out.
        facts: of each of them, in their order.
        duplicates: those that are like one before them.
        outliers: those that look unlike all others, the furthest first.
    """

    references: Collection
    facts: tuple[Facts, ...]
    duplicates: tuple[Duplicate, ...]
    outliers: tuple[Outlier, ...]

    @property
    def skipped(self) -> Mapping[str, str]:
        """Reasons by file, for the files that could not be read."""
        return {printable(path): reason for path, reason in self.references.skipped.items()}

    def record(self) -> dict[str, Any]:
        """As plain values for JSON."""
        return {
            "source": self.references.source,
            "references": [each.record() for each in self.facts],
            "skipped": dict(self.skipped),
            "left_out": dict(self.references.left_out),
            "duplicates": [vars(each) for each in self.duplicates],
            "outliers": [vars(each) for each in self.outliers],
        }


def check(
    references: Collection | str | os.PathLike[str],
    settings: Preparing | None = None,
    *,
    up: str = "y",
    front: str | None = None,
    threads: int | None = None,
) -> Survey:
    """Look at a collection, within seconds; no procedure is needed.

    Args:
        references: a collection, or what ``Collection.load`` reads.
        settings: what is left out, as ``fit`` leaves it out.
        up: see ``Collection.load``.
        front: see ``Collection.load``.
        threads: as many as cores by default.

    Raises CollectionError where nothing can be read, and for names to leave out that are none.
    """
    how = settings or Settings()
    if not isinstance(references, Collection):
        references = Collection.load(references, up=up, front=front)
    chosen = prepared(references, how, threads)
    known = in_threads(lambda reference: facts(reference, how), chosen.references, threads)
    seems = [_seeming(*pair) for pair in zip(chosen, stood(chosen.references, threads=threads), strict=True)]
    like: tuple[Duplicate, ...] = ()
    unlike: tuple[Outlier, ...] = ()
    if all(isinstance(reference.shape, Mesh | Points | Drawing) for reference in chosen):
        seen = pictures([reference.shape for reference in chosen], threads)
        like, unlike = duplicates(chosen.references, seen), outliers(chosen.names, seen)
    told: dict[str, list[str]] = {each.name: [each.words] for each in like}
    for name, words in [*((each.name, each.words) for each in unlike), *other_sizes(known).items()]:
        told.setdefault(name, []).append(words)
    known = [
        replace(each, odd=(*told.get(each.name, ()), *each.odd), seems=words)
        for each, words in zip(known, seems, strict=True)
    ]
    return Survey(chosen, tuple(known), like, unlike)


def _seeming(given: Reference, found: Reference) -> str:
    """The axes of a reference as they were found, in words; empty where it stands so."""
    axes = found.orientation
    return "" if axes == given.orientation else f"{axes.up} up, {axes.front} front"

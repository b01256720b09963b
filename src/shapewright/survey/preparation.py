"""What of a collection is fitted: without what stands around its shapes, with several objects of a file apart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from itertools import chain

import numpy as np

from shapewright.fields import meant
from shapewright.references import Collection, CollectionError, Reference
from shapewright.settings import Preparing, Split
from shapewright.shapes import Ints, Mesh, ReferenceShape
from shapewright.shapes.shelf import fresh, shelved
from shapewright.survey.duplicates import Duplicate, duplicates
from shapewright.survey.extras import Extra, found
from shapewright.survey.likeness import pictures
from shapewright.survey.objects import objects
from shapewright.survey.pieces import Pieces
from shapewright.threads import in_threads

_AT_ONCE = 512
"""References whose shapes are in memory at the same time."""
_AS_LARGE = 1e-4
"""Share by which sizes may differ, where they count, of references that follow one another."""


def prepared(references: Collection, how: Preparing, threads: int | None = None) -> Collection:
    """The references that are fitted; their notes say what was left out of each, ``left_out`` which are none of them.

    A collection that is prepared stays as it is. Raises CollectionError for a name to leave out that is none, and where
    nothing would be left.
    """
    _check(how.patterns, [*references.names, *references.left_out])
    kept = [reference for reference in references if not _is_named(reference, how.patterns)]
    unwanted: list[str] = []

    def wanted() -> Iterator[Reference]:
        for start in range(0, len(kept), _AT_ONCE):
            some = kept[start : start + _AT_ONCE]
            for result in chain.from_iterable(in_threads(lambda each: _in_place(each, how), some, threads)):
                if _is_named(result, how.patterns):
                    unwanted.append(result.name)
                else:
                    yield result

    results = shelved(wanted())
    if not results:
        raise CollectionError(f"leave_out={how.leave_out!r} leaves no reference; leave fewer out")
    whole = {reference.name for reference in kept} | {result.name for result in results}
    gone = dict.fromkeys([*(name for name in references.names if name not in whole), *unwanted], "left out on request")
    return replace(references, references=results, left_out={**references.left_out, **gone})


def _in_place(reference: Reference, how: Preparing) -> list[Reference]:
    """What is fitted of a reference, which stays where it is if that is all of it."""
    copy = replace(reference, shape=fresh(reference.shape))
    return [reference if each is copy else each for each in _prepared(copy, how)]


def without_extras(reference: Reference, how: Preparing) -> Reference:
    """One reference whole, without what stands around it, see ``Preparing.drop``."""
    whole = replace(reference, switches=replace(reference.switches, split="off"))
    return replace(next(_prepared(whole, how)), switches=reference.switches)


def objects_in(reference: Reference, how: Preparing) -> list[Reference]:
    """What is fitted of one file: its objects where it is to be split, see ``Preparing.split``; else itself."""
    return list(_prepared(reference, how))


def following(references: Collection, how: Preparing, threads: int | None = None) -> tuple[Duplicate, ...]:
    """The references that are not fitted for themselves, since they are like one before them in the same pose."""
    if how.duplicates == "each" or len(references) < 2 or references.in_views:
        return ()
    seen = np.concatenate([pictures(some, threads) for some in _some(references)])
    like = duplicates(references.references, seen)
    return tuple(
        each
        for each in like
        if not each.quarters
        and (each.is_equal or how.duplicates == "near")
        and _same_size(references[each.name].extent, references[each.of].extent)
    )


def _some(references: Collection) -> Iterator[list[ReferenceShape]]:
    """The shapes, some at a time."""
    for start in range(0, len(references), _AT_ONCE):
        yield [fresh(reference.shape) for reference in references.references[start : start + _AT_ONCE]]


def leading(references: Collection, like: Sequence[Duplicate]) -> Collection:
    """The references that follow none."""
    followers = {each.name for each in like}
    kept = tuple(reference for reference in references if reference.name not in followers)
    return replace(references, references=kept) if like else references


def _prepared(reference: Reference, how: Preparing) -> Iterator[Reference]:
    own = {word: asked for word in ("drop", "split") if (asked := getattr(reference.switches, word)) is not None}
    how = replace(how, **own) if own else how
    if not isinstance(reference.shape, Mesh) or not (how.dropped or how.split != "off"):
        yield reference
        return
    pieces = Pieces.of(reference.shape)
    extras = [extra for extra in found(pieces) if _is_dropped(extra, how.dropped)]
    rest = np.setdiff1d(np.arange(len(pieces)), np.concatenate([np.empty(0, np.int64), *(e.pieces for e in extras)]))
    notes = (*reference.notes, *(f"left out: {extra.words}" for extra in extras))
    split: Split = how.split if reference.part_of is None else "off"
    parts = objects(pieces, rest, split)
    names: set[str] = set()
    for number, part in enumerate(parts, start=1):
        name = reference.name
        if len(parts) > 1:
            name = f"{name}/{part.name or number}"
            name = f"{name} ({number})" if name in names else name
            names.add(name)
        yield _of_pieces(reference, name, pieces, part.pieces, notes, len(parts))


def _of_pieces(
    reference: Reference, name: str, pieces: Pieces, some: Ints, notes: tuple[str, ...], count: int
) -> Reference:
    """The reference of some pieces of another one; that one itself where they are all."""
    if len(some) == len(pieces):
        return reference
    result = replace(reference.of_faces(np.sort(pieces.faces(some))), notes=notes)
    if count == 1:
        return result
    note = f"one of {count} objects in {reference.name}"
    return replace(result, name=name, part_of=reference.name, notes=(*notes, note))


def _same_size(one: float | None, other: float | None) -> bool:
    return one == other or (one is not None and other is not None and math.isclose(one, other, rel_tol=_AS_LARGE))


def _is_dropped(extra: Extra, dropped: Sequence[str]) -> bool:
    return extra.kind in dropped or (extra.sure and "sure" in dropped)


def _is_named(reference: Reference, patterns: Sequence[str]) -> bool:
    return any(reference.name == each or fnmatchcase(reference.name, each) for each in patterns)


def _check(patterns: Sequence[str], names: Sequence[str]) -> None:
    """Raise CollectionError for a name that is none; names of objects in a file are known when it is split."""
    for pattern in patterns:
        is_plain = not any(sign in pattern for sign in "*?[/")
        if is_plain and pattern not in names:
            raise CollectionError(f"leave_out: there is no reference {pattern!r}{meant(pattern, names)}")

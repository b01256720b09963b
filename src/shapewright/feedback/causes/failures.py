"""References without a replica because the procedure fails: one entry for each line at which it does."""

from __future__ import annotations

from collections.abc import Sequence

from shapewright.building import Build, Failure
from shapewright.feedback.causes.shared import SharedCause


def failures(names: Sequence[str], builds: Sequence[Build]) -> list[SharedCause]:
    """What builds fail at, the commonest line first. names: of their references."""
    found: dict[object, list[tuple[str, Failure]]] = {}
    for name, build in zip(names, builds, strict=True):
        if build.failure:
            found.setdefault(build.failure.where, []).append((name, build.failure))
    entries = []
    for some in found.values():
        count = f"{len(some)} reference{'' if len(some) == 1 else 's'}"
        references = tuple(name for name, _ in some)
        entries.append(SharedCause("not built", f"{some[0][1]}: {count}", references, references[0]))
    return sorted(entries, key=lambda entry: -len(entry.references))

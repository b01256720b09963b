"""The pages of a report: what of many references is on which."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

PAGED = 1000
"""References above which a report has pages: one of 1,000 takes a browser a second to open, and 12 MB."""
ON_A_PAGE = 200
FOLDER = "report"
"""Of all pages but the first."""
_MORE = 60
"""References of the first page besides one of each group."""


@dataclass(frozen=True)
class Page:
    """What a page shows, by name.

    number: 0 for the first page, which shows one of each group.
    groups: members, the representative first where it is shown.
    ungrouped: misfits of no group.
    replicated: the others.
    """

    number: int
    groups: tuple[tuple[str, ...], ...]
    ungrouped: tuple[str, ...]
    replicated: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """All that it shows, in its order."""
        return (*chain.from_iterable(self.groups), *self.ungrouped, *self.replicated)

    @property
    def file(self) -> str:
        """Its path in the run."""
        return f"{FOLDER}/{self.number:04d}.html" if self.number else "report.html"


def divided(
    groups: Sequence[Sequence[str]], ungrouped: Sequence[str], replicated: Sequence[str], asked: Sequence[str] = ()
) -> list[Page]:
    """The pages of a report; one, if it is not about many. asked: references that are on the first as well."""
    count = sum(map(len, groups)) + len(ungrouped) + len(replicated)
    if count <= PAGED:
        return [Page(0, tuple(map(tuple, groups)), tuple(ungrouped), tuple(replicated))]
    heads = tuple((group[0],) for group in groups[:ON_A_PAGE])
    shown = {name for group in heads for name in group}
    wanted = {name for name in asked if name not in shown}
    pages = [
        Page(
            0,
            heads,
            tuple(name for place, name in enumerate(ungrouped) if name in wanted or place < _MORE),
            tuple(name for place, name in enumerate(replicated) if name in wanted or place < _MORE),
        )
    ]
    members = [(number, name) for number, group in enumerate(groups) for name in group]
    for start in range(0, count, ON_A_PAGE):
        stop = start + ON_A_PAGE
        some: dict[int, list[str]] = {}
        for number, name in members[start:stop]:
            some.setdefault(number, []).append(name)
        before, after = len(members), len(members) + len(ungrouped)
        pages.append(
            Page(
                len(pages),
                tuple(map(tuple, some.values())),
                tuple(ungrouped[max(start - before, 0) : max(stop - before, 0)]),
                tuple(replicated[max(start - after, 0) : max(stop - after, 0)]),
            )
        )
    return pages

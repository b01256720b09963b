"""What to do next: the largest group, the longest region that nothing explains, the best change that was tried."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from shapewright.studio.session.board import Board
from shapewright.studio.wire.detail import BestChange, NextStep


def next_step(board: Board, explanation: Mapping[str, Any]) -> NextStep:
    """Of the run that is shown. explanation: as its folder has it; empty where there is none."""
    open_ones = {slug: one for slug, one in board.references.items() if one.grade != "replicated" and one.replica}
    groups = [[slug for slug in group.members if slug in open_ones] for group in board.groups]
    members = max(groups, key=len, default=[])
    chosen = next((group.representative for group in board.groups if {*members} & {*group.members}), None)
    first = open_ones.get(chosen if chosen in members else members[0]) if members and chosen is not None else None
    longest = max(open_ones.values(), key=lambda one: one.missing[0].size if one.missing else 0.0, default=None)
    length = longest.missing[0].size if longest and longest.missing else None
    return NextStep(
        group=first.slug if first else None,
        members=len(members) if first else 0,
        lacks=first.missing[0].size if first and first.missing else None,
        longest=longest.slug if longest and length else None,
        length=length,
        best=_best(explanation),
    )


def _best(explanation: Mapping[str, Any]) -> BestChange | None:
    """The first suggestion; else what came nearest among all that was tried."""
    for place, given in enumerate(explanation.get("suggestions") or ()):
        gain, tried = int(given.get("gain") or 0), given.get("tried") or {}
        return BestChange(
            title=str(given.get("title", "")), gain=gain, nearer=gain + int(tried.get("nearer") or 0), suggestion=place
        )
    tried = [one for one in explanation.get("tried") or () if one.get("nearer") and one.get("best") is not None]
    if not tried:
        return None
    best = min(tried, key=lambda one: (one["best"], -one["nearer"]))
    return BestChange(title=str(best["title"]), gain=0, nearer=int(best["nearer"]), suggestion=None)

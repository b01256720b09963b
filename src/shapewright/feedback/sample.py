"""Of very many references some that are explained: members of each group, and some replicated ones."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice, zip_longest

import numpy as np

from shapewright.runs.iteration import Iteration

MOST = 600
"""References that are explained, at most: that takes some minutes. Suggestions are tried on their misfits."""
_REPLICATED = 1 / 4
"""Of these, at most: no change may lose a replicated reference."""


def sample_of(iteration: Iteration, most: int = MOST, seed: int = 0) -> Iteration:
    """The iteration with at most so many results, in their order; itself where it has no more.

    The representative of each group comes first, then one more member of each, and so on; the largest groups first.
    Replicated references are drawn at random.
    """
    results = iteration.results
    if len(results) <= most:
        return iteration
    known = set(iteration.names)
    groups = sorted(iteration.groups, key=len, reverse=True)
    ordered = [[group.representative, *(m for m in group.members if m != group.representative)] for group in groups]
    turns = (name for turn in zip_longest(*ordered) for name in turn if name in known)
    good = [result.name for result in results if result.grade == "replicated"]
    drawn = np.random.default_rng(seed).permutation(len(good))[: int(_REPLICATED * most)]
    chosen = {good[i] for i in drawn}
    chosen |= set(islice(turns, most - len(chosen)))
    return replace(iteration, results=tuple(result for result in results if result.name in chosen))

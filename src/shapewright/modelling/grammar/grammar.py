"""A split grammar: rules divide a box into boxes until no tag has a rule left, and the boxes become a shape.

A rule is a function, marked with the tag of the boxes that it is for; it takes such a box, and by name whatever
parameters it asks for, and yields boxes, each with a tag for the rules to come:

    table = Grammar()

    @table.rule("table")
    def parts(box, thickness):
        under, top = box.split("y", ..., thickness)
        yield under.tag("base")
        yield top.tag("top")

    @table.rule("base")
    def legs(box, leg):
        yield from (corner.tag("legs") for corner in box.corners(leg))

    table.derive((1.2, 0.7, 0.8), thickness=0.04, leg=0.06).mesh()

A box whose tag has no rule is done, and the tag is its label; so is one without a tag, labelled like the box that it
was made from. What else a box can do is in ``Box``: docs/modelling.md shows it in pictures.
"""

from __future__ import annotations

import inspect
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from shapewright.modelling.arguments import Vector
from shapewright.modelling.arguments import size as checked_size
from shapewright.modelling.curves import TOLERANCE
from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.grammar.derivation import Derivation
from shapewright.modelling.grammar.expansion import Expansion, GrammarError, Rule

F = TypeVar("F", bound=Callable[..., Any])


class Grammar:
    """Rules for boxes by tag.

    start: the tag that a derivation starts from, by default that of the first rule.
    tolerance: how far round and bent parts may be from their facets, as a part of the shape's largest extent.
    """

    def __init__(self, start: str | None = None, tolerance: float = TOLERANCE) -> None:
        self.start, self.tolerance = start, tolerance
        self._rules: dict[str, list[Rule]] = {}

    def rule(self, tag: str, when: Callable[[Any], bool] | None = None) -> Callable[[F], F]:
        """Make the function below a rule for boxes of this tag.

        The function takes the box, and further arguments by the names of parameters given to ``derive``; it yields or
        returns boxes. when: says whether it applies, given all parameters as attributes (``lambda p: p.arms``). Of
        several rules for one tag the first that applies is taken.
        Raises GrammarError for a rule that could never apply, because one before it always does, and a name used twice.
        """

        def register(function: F) -> F:
            others = self._rules.setdefault(tag, [])
            if always := next((other for other in others if other.when is None), None):
                raise GrammarError(
                    f"rule {function.__name__}() for {tag!r} would never apply: {always.name}() before it always does; "
                    "give that one a when=, or write it last"
                )
            if any(rule.name == function.__name__ and rule.function is not function for rule in self.rules):
                raise GrammarError(f"there is a rule {function.__name__}() already; name this one differently")
            extra = list(inspect.signature(function).parameters.values())[1:]
            takes = tuple(item.name for item in extra)
            needs = tuple(item.name for item in extra if item.default is item.empty)
            others.append(Rule(tag, function, when, needs, takes))
            self.start = self.start or tag
            return function

        return register

    @property
    def rules(self) -> tuple[Rule, ...]:
        return tuple(rule for rules in self._rules.values() for rule in rules)

    def __len__(self) -> int:
        """The number of rules."""
        return len(self.rules)

    def derive(self, size: float | Vector, /, **parameters: Any) -> Derivation:
        """Apply rules from a box of this size on, which stands on the ground (y = 0) in the middle of x and z.

        Raises GrammarError where no rule fits, where a rule divides a box into more than there is of it, where it asks
        for a parameter that is not given, and for endless recursion.
        """
        width, height, depth = checked_size("derive", size)
        box = Box((-width / 2.0, 0.0, -depth / 2.0), (width / 2.0, height, depth / 2.0))
        expansion = Expansion(self._rules, parameters)
        root = expansion.expand(box.tag(self.start or ""), "", "", "", ())
        return Derivation(root, self.tolerance * max(width, height, depth))

    def check(self, derivations: Iterable[Derivation]) -> Counter[str]:
        """How often each rule was applied in all of these derivations, such as those of a thousand random parameters.

        Raises GrammarError when some rule never was: its tag is misspelt, or nothing leads to it.
        """
        counts, tags = Counter({rule.name: 0 for rule in self.rules}), set()
        for derivation in derivations:
            counts.update(derivation.counts)
            tags |= {node.box.symbol for node in derivation.root}
        if idle := [rule for rule in self.rules if not counts[rule.name]]:
            reasons = ", ".join(
                f"{rule.name}() for {rule.tag!r} ({'its when= never held' if rule.tag in tags else 'no such box'})"
                for rule in idle
            )
            there = ", ".join(sorted(tags - {""}))
            raise GrammarError(f"rules that never applied: {reasons}; there were boxes {there}")
        return counts

"""Rules applied to a box, and to what they make of it, until no tag has a rule left."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.grammar.forms import Group

DEPTH, BOXES = 64, 20_000  # rules in a row and boxes of one derivation, from which on a recursion counts as endless


class GrammarError(ValueError):
    """A grammar that cannot be right, or a rule that cannot be applied; the message names the rule and the box."""


@dataclass(frozen=True, slots=True)
class Rule:
    """A function for boxes of a tag.

    tag: of the boxes that it is for.
    function: takes such a box, and parameters by name; yields boxes.
    when: whether it applies, given the parameters as attributes; None: always.
    needs: names of the parameters that it cannot do without.
    takes: names of all parameters that it takes.
    """

    tag: str
    function: Callable[..., Any]
    when: Callable[[Any], bool] | None
    needs: tuple[str, ...]
    takes: tuple[str, ...]

    @property
    def name(self) -> str:
        return self.function.__name__


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """A box of a derivation.

    box: with its tag.
    label: of its own, of an ancestor, or its tag.
    made_by: name of the rule that made it, "" for the first box.
    rule: name of the rule that was applied to it, "" for a box that is done.
    children: the boxes that this rule made of it.
    """

    box: Box
    label: str
    made_by: str
    rule: str = ""
    children: tuple[Node, ...] = ()

    def __iter__(self) -> Iterator[Node]:
        """This node and all below it."""
        yield self
        for child in self.children:
            yield from child


class Expansion:
    """One derivation while it grows: the rules by tag, the parameters, and how many boxes there are by now."""

    def __init__(self, rules: Mapping[str, Sequence[Rule]], parameters: dict[str, Any]) -> None:
        self.rules, self.parameters = rules, parameters
        self.namespace = SimpleNamespace(**parameters)
        self.boxes = 0

    def expand(self, box: Box, label: str, fallback: str, made_by: str, path: tuple[str, ...]) -> Node:
        """label: what an ancestor's ``label`` says. fallback: the tag of the box that this one was made from."""
        self.boxes += 1
        label = dict(box.names).get(None, label) if box.names else label
        rule = self._rule(box) if box.symbol in self.rules else None
        if rule is None:
            if 0.0 in box.size:
                raise GrammarError(
                    f"rule {made_by}(): the box {box.symbol!r} ({box}) has no thickness; extrude the patch, or let a "
                    "rule for its tag do so"
                )
            return Node(box, label or box.symbol or fallback, made_by)
        if len(path) >= DEPTH or self.boxes > BOXES:
            raise GrammarError(
                f"endless recursion: {_at(rule, box)}, after {len(path)} rules in a row ({' > '.join(path[-4:])}) "
                f"and {self.boxes} boxes"
            )
        if box.form:
            raise GrammarError(
                f"rule {rule.name}() cannot be applied to the box {box.symbol!r} ({box}), which is rounded or filled"
            )
        path = (*path, rule.name)
        children = tuple(self.expand(child, label, box.symbol, rule.name, path) for child in self._apply(rule, box))
        return Node(box, label or box.symbol, made_by, rule.name, children)

    def _rule(self, box: Box) -> Rule:
        rules = self.rules[box.symbol]
        for rule in rules:
            if rule.when is None or rule.when(self.namespace):
                return rule
        raise GrammarError(
            f"no rule applies to the box {box.symbol!r} ({box}): the when= of "
            f"{', '.join(f'{rule.name}()' for rule in rules)} does not hold for {self.parameters}"
        )

    def _apply(self, rule: Rule, box: Box) -> list[Box]:
        if missing := [name for name in rule.needs if name not in self.parameters]:
            raise GrammarError(f"{_at(rule, box)}: it asks for {', '.join(missing)}, which derive() was not given")
        arguments = {name: self.parameters[name] for name in rule.takes if name in self.parameters}
        inner = box.within()
        try:
            made = rule.function(inner, **arguments)
            made = [made] if isinstance(made, Box) else None if made is None else list(made)
        except GrammarError:
            raise
        except ValueError as error:
            raise GrammarError(f"{_at(rule, box)}: {error}") from error
        if made is None or not all(isinstance(child, Box) for child in made):
            raise GrammarError(f"{_at(rule, box)}: it must yield boxes, or return one or a list of them")
        if not box.is_void and any(child.is_void for child in made):
            outer, scope = inner.groups, Group(scope=self.boxes)
            made = [child._replace(groups=(*outer, scope, *child.groups[len(outer) :])) for child in made]
        return made


def _at(rule: Rule, box: Box) -> str:
    return f"rule {rule.name}() on the box {box.symbol!r} ({box})"

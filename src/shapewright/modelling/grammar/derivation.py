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
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any, Literal, TypeVar

from shapewright.modelling.arguments import Vector
from shapewright.modelling.arguments import size as checked_size
from shapewright.modelling.curves import TOLERANCE
from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.grammar.divisions import share
from shapewright.modelling.grammar.forms import SIDES, Group, Side
from shapewright.modelling.solid.solid import Solid
from shapewright.shapes import Floats, Mesh

__all__ = ["SIDES", "Box", "Derivation", "Grammar", "GrammarError", "Node", "Rule", "Side", "share"]

DEPTH, BOXES = 64, 20_000
_naming: ContextVar[Literal["label", "rule"]] = ContextVar("naming", default="label")
F = TypeVar("F", bound=Callable[..., Any])


class GrammarError(ValueError):
    """A grammar that cannot be right, or a rule that cannot be applied; the message names the rule and the box."""


@contextmanager
def named_by(names: Literal["label", "rule"]) -> Iterator[None]:
    """What meshes and solids of derivations are labelled by, inside the block, where they are not told."""
    token = _naming.set(names)
    try:
        yield
    finally:
        _naming.reset(token)


@dataclass(frozen=True, slots=True)
class Rule:
    """A function for boxes of a tag. when: whether it applies, given the parameters as attributes; None: always."""

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
    """A box of a derivation, the rule that was applied to it, if any, and what that made of it."""

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


class Grammar:
    """Rules for boxes by tag. ``start`` is the tag that a derivation starts from: that of the first rule by default.

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
            always = next((other for other in others if other.when is None), None)
            if always:
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
        expansion = _Expansion(self._rules, parameters)
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
        idle = [rule for rule in self.rules if not counts[rule.name]]
        if idle:
            reasons = ", ".join(
                f"{rule.name}() for {rule.tag!r} ({'its when= never held' if rule.tag in tags else 'no such box'})"
                for rule in idle
            )
            raise GrammarError(
                f"rules that never applied: {reasons}; there were boxes {', '.join(sorted(tags - {''}))}"
            )
        return counts


@dataclass(frozen=True, eq=False)
class Derivation:
    """What a grammar made of a box: a tree, and the shape that its leaves make. tolerance: of facets, a length."""

    root: Node
    tolerance: float

    @cached_property
    def leaves(self) -> tuple[Node, ...]:
        """The boxes that are done."""
        return tuple(node for node in self.root if not node.rule)

    @property
    def counts(self) -> Counter[str]:
        """How often each rule was applied."""
        return Counter(node.rule for node in self.root if node.rule)

    def mesh(self, by: Literal["label", "rule"] | None = None, join: bool = True) -> Mesh:
        """The shape: one closed surface, each face labelled with its label (the default) or the rule that made it.

        join: unite all boxes, so that the mesh is sound; False leaves each its own closed surface, which takes less
        time and looks the same from outside.
        """
        from shapewright.modelling.grammar import assembly  # compiled code, which takes a while to load

        make = assembly.mesh if join else assembly.apart
        return make(self._leaves(), self.tolerance, (by or _naming.get()) == "rule")

    def solid(self, by: Literal["label", "rule"] | None = None) -> Solid:
        """The shape as a solid of the kit, to go on with."""
        from shapewright.modelling.grammar.assembly import joined

        return joined(self._leaves(), self.tolerance, (by or _naming.get()) == "rule")

    @property
    def label_names(self) -> tuple[str, ...]:
        """The labels of its boxes."""
        return tuple(dict.fromkeys(leaf.label for leaf in self._leaves() if leaf.label))

    def part(self, name: str) -> Solid:
        """The boxes that bear a label, as a solid: ``part("top").bounds``. Raises ValueError when there is none."""
        found = [leaf for leaf in self._leaves() if leaf.label == name]
        if not found:
            labels = ", ".join(self.label_names) or "none"
            raise ValueError(f"part: no box is labelled {name!r}; the labels are: {labels}")
        return self._solid(found)

    def without(self, *names: str) -> Solid:
        """The shape without the boxes that bear these labels, as a solid; empty when nothing is left."""
        return self._solid([leaf for leaf in self._leaves() if leaf.label not in names])

    def __or__(self, other: Solid) -> Solid:
        """Union with a solid."""
        return self.solid() | other if isinstance(other, Solid) else NotImplemented

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner."""
        return self.solid().bounds

    def _solid(self, leaves: list[Any]) -> Solid:
        from shapewright.modelling.grammar.assembly import joined

        return joined(leaves, self.tolerance, False)

    def _leaves(self) -> list[Any]:
        from shapewright.modelling.grammar.assembly import Leaf

        if not self.leaves:
            raise GrammarError(f"nothing is left: no rule yields a box that is done\n{self}")
        return [Leaf(node.box, node.label, node.made_by) for node in self.leaves]

    def __str__(self) -> str:
        """The tree, a box a line: its tag, size and place, and the rule that was applied to it."""
        return "\n".join(_lines(self.root, "", ""))


class _Expansion:
    """One derivation while it grows."""

    def __init__(self, rules: dict[str, list[Rule]], parameters: dict[str, Any]) -> None:
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
                f"endless recursion: rule {rule.name}() on the box {box.symbol!r} ({box}), after "
                f"{len(path)} rules in a row ({' > '.join(path[-4:])}) and {self.boxes} boxes"
            )
        if box.form:
            raise GrammarError(
                f"rule {rule.name}() cannot be applied to the box {box.symbol!r} ({box}), which is rounded or filled"
            )
        children = self._apply(rule, box)
        return Node(
            box,
            label or box.symbol,
            made_by,
            rule.name,
            tuple(self.expand(child, label, box.symbol, rule.name, (*path, rule.name)) for child in children),
        )

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
        missing = [name for name in rule.needs if name not in self.parameters]
        if missing:
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


def _lines(node: Node, first: str, further: str) -> Iterator[str]:
    what = f"{node.rule}()" if node.rule else node.label
    mark = " void" if node.box.is_void else ""
    yield f"{first}{node.box.symbol or '-'}{mark}  {node.box}  {what}"
    for child in node.children:
        last = child is node.children[-1]
        yield from _lines(child, further + ("└─ " if last else "├─ "), further + ("   " if last else "│  "))

"""What a grammar makes of a box: a tree of boxes, and the shape that its leaves make."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from shapewright.modelling.grammar.expansion import GrammarError, Node
from shapewright.modelling.solid.solid import Solid
from shapewright.shapes import Floats, Mesh


@dataclass(frozen=True, eq=False)
class Derivation:
    """What a grammar made of a box, and the shape that this is.

    root: of the tree of boxes.
    tolerance: how far facets may be from the smooth shape, a length.
    """

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

    def mesh(self, by: Literal["label", "rule"] = "label", join: bool = True) -> Mesh:
        """The shape: one closed surface, whose faces know their labels and the rules that made them.

        Boxes of one label that lie flush share faces, and such a face knows one of their rules.
        by: what faces are labelled with.
        join: True unites all boxes, so that the mesh is sound. False leaves every box its own closed surface, which
            takes less time and looks the same from outside.
        """
        from shapewright.modelling.grammar import assembly  # compiled code, which takes a while to load

        made = (assembly.mesh if join else assembly.apart)(self._done(), self.tolerance)
        return replace(made, face_labels=made.face_rules, label_names=made.rule_names) if by == "rule" else made

    def solid(self) -> Solid:
        """The shape as a solid of the kit, for further work; its mesh knows the rules too."""
        return self._solid(self._done())

    @property
    def label_names(self) -> tuple[str, ...]:
        """The labels of its boxes."""
        return tuple(dict.fromkeys(leaf.label for leaf in self._done() if leaf.label))

    def part(self, name: str) -> Solid:
        """The boxes that bear a label, as a solid: ``part("top").bounds``. Raises ValueError when there is none."""
        found = [leaf for leaf in self._done() if leaf.label == name]
        if not found:
            labels = ", ".join(self.label_names) or "none"
            raise ValueError(f"part: no box is labelled {name!r}; the labels are: {labels}")
        return self._solid(found)

    def without(self, *names: str) -> Solid:
        """The shape without the boxes that bear these labels, as a solid; empty when nothing is left."""
        return self._solid([leaf for leaf in self._done() if leaf.label not in names])

    def __or__(self, other: Solid) -> Solid:
        """Union with a solid."""
        return self.solid() | other if isinstance(other, Solid) else NotImplemented

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner."""
        return self.solid().bounds

    def _solid(self, leaves: Sequence[Node]) -> Solid:
        from shapewright.modelling.grammar.assembly import joined

        return joined(leaves, self.tolerance)

    def _done(self) -> tuple[Node, ...]:
        """The boxes that are done, of which there must be one."""
        if not self.leaves:
            raise GrammarError(f"nothing is left: no rule yields a box that is done\n{self}")
        return self.leaves

    def __str__(self) -> str:
        """The tree, a box a line: its tag, size and place, and the rule that was applied to it."""
        return "\n".join(_lines(self.root, "", ""))


def _lines(node: Node, first: str, further: str) -> Iterator[str]:
    what = f"{node.rule}()" if node.rule else node.label
    mark = " void" if node.box.is_void else ""
    yield f"{first}{node.box.symbol or '-'}{mark}  {node.box}  {what}"
    for child in node.children:
        last = child is node.children[-1]
        yield from _lines(child, further + ("└─ " if last else "├─ "), further + ("   " if last else "│  "))

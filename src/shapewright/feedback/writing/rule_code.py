"""The code of a rule, from pieces that several misfits share: a function, and parameters with Ranges.

A rule says sizes and places relative to the bounding box of a part, or of the whole shape: the one that leaves the
fewest quantities free. Free quantities become parameters.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.relations import INNER, NEW, WHOLE, Frames, best_frame, inside_of, made_bounds
from shapewright.feedback.writing.edit import NewParameter, NewRule
from shapewright.feedback.writing.piece_code import LINE, Quantity, kit_functions, noun, piece_lines, quoted, variable
from shapewright.feedback.writing.rule_text import rule_text
from shapewright.rules.rule import Rule


@dataclass(frozen=True)
class RuleDraft:
    """A change as code."""

    name: str  # of its function, or of its flag where it needs none
    flag: str | None  # the binary that switches it on; None when the parameters' defaults leave the shape unchanged
    function: str  # its text; empty where the call needs none
    call: str  # an expression for the changed shape, in which ``{shape}`` stands for the shape before
    quantities: tuple[Quantity, ...]  # what becomes a parameter
    imports: tuple[str, ...]  # the functions of the kit that it needs
    rules: tuple[Rule, ...] = ()  # of the library, that it needs
    alone: str = ""  # a function like that above, of the new pieces without the rest; empty where there are none

    @property
    def lines(self) -> int:
        """Of code that it adds: of its functions, and one for each parameter."""
        texts = [*(rule_text(rule).functions for rule in self.rules), self.function]
        return sum(text.count("\n") + 1 for text in texts if text) + len(self.quantities) + 1

    def spelled(self, ranges: Mapping[str, tuple[float, float, float]]) -> NewRule:
        """The rule with these ranges (low, high, default) of its quantities."""
        parameters = [NewParameter(self.flag, "bool", str(not self.function))] if self.flag else []
        parameters += [q.parameter(*ranges[q.name], self.flag) for q in self.quantities]
        texts = [rule_text(rule) for rule in self.rules]
        imports = _merged([{"shapewright.modelling.solids": self.imports}, *(text.imports for text in texts)])
        if self.quantities:
            imports = {"typing": ("Annotated",), "shapewright": ("Range",), **imports}
        function = "\n\n\n".join([*(text.functions for text in texts), self.function])
        when = self.flag if self.function or not self.flag else f"not {self.flag}"
        return NewRule(tuple(parameters), function, self.call, when, imports)


def addition(
    pieces: Sequence[Sequence[Piece]],
    frames: Sequence[Frames],
    removed: Sequence[str],
    inset: Sequence[float] | None,
    labels: Sequence[str],
    free: Callable[[str], str],
    note: str,
) -> RuleDraft:
    """A rule that puts pieces in, perhaps in place of parts.

    Args:
        pieces: for each piece of the rule, how each misfit needs it.
        frames: bounding boxes of each misfit's replica and its parts.
        removed: labels of the parts that go.
        inset: the factor by which each misfit needs all else drawn in; None where it stays.
        labels: of the pieces; "" for one that gets a name.
        free: makes a name that is not taken in the file.
        note: for the docstring.
    """
    order = sorted(range(len(pieces)), key=lambda i: not any(pieces[i][0].mirrored))  # others reach from side to side
    pieces, labels = [pieces[i] for i in order], [labels[i] for i in order]
    nouns = _distinct([noun(several) for several in pieces])
    stem = free("_and_".join(nouns)[:40].strip("_"))
    body: list[str] = []
    quantities: list[Quantity] = []
    names: list[str] = []
    known = [dict(each) for each in frames]
    room = ""
    for several, word, label in zip(pieces, nouns, labels, strict=True):
        frame, along = best_frame(several, known)
        lines, asked = piece_lines(several, known, frame, along, free(word), label or word)
        made = variable(several[0], free(word))
        for each, piece in zip(known, several, strict=True):
            outer = made_bounds(piece, frame, along, each)
            each[f"{NEW}{made}"] = outer
            each[f"{INNER}{NEW}{made}"] = inside_of(piece, outer)
        body += lines[1:] if lines[0] == room else lines
        room = next((line for line in lines if line.startswith("room = ")), room)
        quantities += asked
        names.append(made)
    rest = f"shape.without({', '.join(map(quoted, removed))})" if removed else "shape"
    if inset is not None:
        factor = free(f"{stem}_inset")
        quantities.append(Quantity(factor, tuple(inset)))
        rest = f"{rest}.scale(({factor}, 1, {factor}){_about(frames)})"
    verb = "replace" if removed else "add"
    name = free(f"{verb}_{_plain(removed[0])}" if removed else f"{verb}_{stem}")
    arguments = ", ".join(["shape", *(q.name for q in quantities)])
    head = f"def {name}({arguments}):"
    if len(head) > LINE + 4:
        head = f"def {name}(\n    {arguments}\n):"
    head = "\n    ".join([head, f'"""{note}"""', *body])
    whole, alone = (f"{head}\n    return {' | '.join(made)}" for made in ([rest, *names], names))
    call = f"{name}({', '.join(['{shape}', *(q.name for q in quantities)])})"
    flag = free(f"with_{stem}") if any(several[0].rule for several in pieces) else stem  # the rule has the plain name
    imports = kit_functions([*body, rest])
    rules = tuple({piece.rule.name: piece.rule for piece, *_ in pieces if piece.rule}.values())
    return RuleDraft(name, flag, whole, call, tuple(quantities), imports, rules, alone)


def drawing_in(
    label: str, scales: Sequence[tuple[float, float]], frames: Sequence[Frames], free: Callable[[str], str], note: str
) -> RuleDraft:
    """A rule that draws a part in towards the middle, along x and z."""
    plain = _plain(label)
    quantities = _sideways(f"{plain}_inset", scales, free)
    x, z = (quantity.name for quantity in quantities)
    name = free(f"draw_in_{plain}")
    lines = [
        f"def {name}(shape, {x}, {z}):",
        f'"""{note}"""',
        f"return shape.without({quoted(label)}) | shape.part({quoted(label)}).scale(({x}, 1, {z}){_about(frames)})",
    ]
    return RuleDraft(name, None, "\n    ".join(lines), f"{name}({{shape}}, {x}, {z})", quantities, ())


def splaying(
    label: str,
    scales: Sequence[tuple[float, float]],
    removed: Sequence[str],
    everywhere: bool,
    free: Callable[[str], str],
    note: str,
) -> RuleDraft:
    """A rule that moves the low end of a part away from its middle. everywhere: whether all shapes have the part."""
    plain = _plain(label)
    quantities = _sideways(f"{plain}_splay", scales, free)
    x, z = (quantity.name for quantity in quantities)
    name = free(f"splay_{plain}")
    rest = f"shape.without({', '.join(map(quoted, [label, *removed]))})"
    lines = [
        f"def {name}(shape, {x}, {z}):",
        f'"""{note}"""',
        *([] if everywhere else [f"if {quoted(label)} not in shape.label_names:", "    return shape"]),
        f'return {rest} | shape.part({quoted(label)}).taper(({x}, {z}), "-y")',
    ]
    flag = free(f"{plain}_splayed") if removed else None
    return RuleDraft(name, flag, "\n    ".join(lines), f"{name}({{shape}}, {x}, {z})", quantities, ())


def removal(label: str, free: Callable[[str], str]) -> RuleDraft:
    """A rule that makes a part optional."""
    flag = free(f"with_{_plain(label)}")
    return RuleDraft(flag, flag, "", f"{{shape}}.without({quoted(label)})", (), ())


def _merged(several: Sequence[Mapping[str, tuple[str, ...]]]) -> dict[str, tuple[str, ...]]:
    """The names to import by module; modules without names are left out."""
    merged: dict[str, tuple[str, ...]] = {}
    for imports in several:
        for module, names in imports.items():
            merged[module] = tuple(dict.fromkeys([*merged.get(module, ()), *names]))
    return {module: names for module, names in merged.items() if names}


def _sideways(name: str, scales: Sequence[tuple[float, float]], free: Callable[[str], str]) -> tuple[Quantity, ...]:
    """The factors along x and z that each misfit wants."""
    return tuple(Quantity(free(f"{name}_{axis}"), tuple(scale[i] for scale in scales)) for i, axis in enumerate("xz"))


def _about(frames: Sequence[Frames]) -> str:
    """The argument that makes the shape's middle the one that stays, where that is not the origin."""
    wholes = [each[WHOLE] for each in frames]
    centred = all(np.abs(whole.sum(axis=0)[[0, 2]]).max() < 2e-3 * np.ptp(whole, axis=0).max() for whole in wholes)
    return "" if centred else ", about=shape.bounds.mean(axis=0)"


def _distinct(nouns: Sequence[str]) -> list[str]:
    numbers = [nouns[: i + 1].count(word) for i, word in enumerate(nouns)]
    return [word if number == 1 else f"{word}_{number}" for word, number in zip(nouns, numbers, strict=True)]


def _plain(label: str) -> str:
    return re.sub(r"\W+", "_", label).strip("_").lower()

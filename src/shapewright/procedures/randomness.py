"""Lines of an author's files whose outcome may differ from call to call with the same arguments."""

from __future__ import annotations

import ast
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from shapewright.procedures.openscad.text import Text
from shapewright.procedures.places import Place
from shapewright.procedures.procedure import Procedure

ChanceKind: TypeAlias = Literal["random", "set", "moment"]

_KINDS: tuple[ChanceKind, ...] = ("random", "set", "moment")
_FROM_SEED = ("seed", "get_state", "set_state", "getstate", "setstate", "manual_seed")
_GENERATORS = ("default_rng", "RandomState", "Random", "Generator", "SeedSequence", "PCG64", "MT19937")
_TORCH = ("rand", "randn", "randint", "randperm", "normal", "rand_like", "randn_like")
_MOMENTS = {
    "time": ("time", "time_ns", "perf_counter", "perf_counter_ns", "monotonic", "monotonic_ns", "process_time"),
    "datetime": ("now", "today", "utcnow"),
    "id": ("",),
}


@dataclass(frozen=True)
class Chance:
    """One such line.

    kind: numbers drawn without a seed; the order of a set; a moment, or the address of an object.
    place: where it is.
    call: what is called there, by the full name of its module.
    """

    kind: ChanceKind
    place: Place
    call: str

    @property
    def says(self) -> str:
        return {
            "random": f"{self.call} draws without a seed",
            "set": "the order of a set decides",
            "moment": f"{self.call} is another each time",
        }[self.kind]


def chances(procedure: Procedure) -> list[Chance]:
    """Those of the procedure's file, then of its helpers, likelier kinds first; of the function where it has no file.

    A generator that gets a seed is none. What other modules do is not seen.
    """
    path = procedure.path
    texts = [(str(path or procedure.place.file), procedure.source, 1 if path else procedure.place.line or 1)]
    texts += [(str(file), _read(file), 1) for file in procedure.helpers if file.suffix in (".py", ".scad")]
    found = [
        chance
        for file, text, first in texts
        for chance in (_of_openscad(file, text) if file.lower().endswith(".scad") else _of_text(file, text, first))
    ]
    return sorted(found, key=lambda chance: _KINDS.index(chance.kind))


def _read(file: Path) -> str:
    try:
        return file.read_text("utf-8")
    except (OSError, UnicodeDecodeError):
        return ""


def _of_openscad(file: str, text: str) -> Iterator[Chance]:
    """Calls of ``rands`` with three values: the fourth is the seed."""
    lines = text.splitlines()
    for line in Text.of(text).calls("rands", 3):
        yield Chance("random", Place(file, line, lines[line - 1].strip()), "rands")


def _of_text(file: str, text: str, first: int) -> Iterator[Chance]:
    """first: the number of the text's first line in its file."""
    try:
        tree = ast.parse(textwrap.dedent(text))
    except (SyntaxError, ValueError):
        return
    names, lines = _imported(tree), text.splitlines()
    sets = {
        t.id
        for n in ast.walk(tree)
        if isinstance(n, ast.Assign) and _is_set(n.value)
        for t in n.targets
        if isinstance(t, ast.Name)
    }
    for node in ast.walk(tree):
        kind, call = _kind(node, names, sets)
        if kind:
            line = node.iter.lineno if isinstance(node, ast.comprehension) else getattr(node, "lineno", 1)
            yield Chance(kind, Place(file, line + first - 1, lines[line - 1].strip()), call)


def _imported(tree: ast.AST) -> dict[str, str]:
    """The full name of everything that an import binds."""
    names = {"np": "numpy", "numpy": "numpy", "random": "random", "torch": "torch", "time": "time", "uuid": "uuid"}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {
                a.asname or a.name.partition(".")[0]: a.name if a.asname else a.name.partition(".")[0]
                for a in node.names
            }
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {a.asname or a.name: f"{node.module}.{a.name}" for a in node.names}
    return names


def _kind(node: ast.AST, names: dict[str, str], sets: set[str]) -> tuple[ChanceKind | None, str]:
    if isinstance(node, ast.For | ast.comprehension) and (_is_set(node.iter) or getattr(node.iter, "id", "") in sets):
        return "set", ""
    if isinstance(node, ast.Call):
        call = _full_name(node.func, names)
        module, _, name = call.rpartition(".")
        if _draws(module, name, bool(node.args or node.keywords)):
            return "random", call
        if name in _MOMENTS.get(module.rpartition(".")[2], ()) or call == "id":
            return "moment", call
    return None, ""


def _draws(module: str, name: str, seeded: bool) -> bool:
    if module in ("random", "numpy.random", "np.random"):
        return not seeded if name in _GENERATORS else name not in _FROM_SEED
    if module == "torch":
        return name in _TORCH
    return module in ("secrets", "uuid") or (module, name) == ("os", "urandom")


def _is_set(node: ast.AST) -> bool:
    called = isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("set", "frozenset")
    return called or isinstance(node, ast.Set | ast.SetComp)


def _full_name(node: ast.AST, names: dict[str, str]) -> str:
    """Of what is called: ``np.random.randn`` is numpy.random.randn."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    if not isinstance(node, ast.Name):
        return ""
    return ".".join([names.get(node.id, node.id), *reversed(parts)])

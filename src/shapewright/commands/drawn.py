"""A function of procfunc that draws at random, as a procedure: its draws are the parameters."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from shapewright.commands.elsewhere import ask
from shapewright.commands.procfunc.drawn_space import Draw, Forced, Record, read_draws, settled
from shapewright.commands.procfunc.naming import Site, site
from shapewright.commands.spec import Spec, read_spec
from shapewright.procedures import ProcedureError

_read: dict[str, tuple[dict[str, Draw], list[str]]] = {}
"""What was read in this process, by what was asked: to read takes as long as some dozen shapes."""


def with_draws(spec: Spec) -> Spec:
    """The spec with the draws of its function as parameters; what it says of them goes before what is read.

    Raises ProcedureError where the function cannot be called, draws nothing, or does not know a name of the spec.
    """
    arguments = {name: value for name, value in spec.entries.fixed.items() if name != "rng"}
    seed = spec.entries.fixed.get("rng", 0)
    if not isinstance(seed, int):
        raise spec.file.error(("parameters", "rng"), f"{seed!r} is no whole number; it is the seed of what is held")
    asked = json.dumps([spec.python, spec.target, arguments, seed, dict(spec.environment)], default=str)
    if asked not in _read:
        _read[asked] = _drawn(spec, arguments, seed)
    draws, takes = _read[asked]
    if not draws:
        raise ProcedureError(f"{spec.target} draws nothing that has a range", spec.place)
    for name, own in {**spec.entries.names, **{name: name for name in spec.entries.fixed}}.items():
        if own not in draws and own not in takes:
            message = f"{spec.target} draws no such value, and takes no such argument; it draws {', '.join(draws)}"
            raise spec.file.error(("parameters", own), message)
        fixed = spec.entries.fixed.get(name)
        if own in draws and draws[own].options and name in spec.entries.fixed and fixed not in draws[own].options:
            options = ", ".join(map(repr, draws[own].options))
            raise spec.file.error(("parameters", own), f"{fixed!r} is no option; there are {options}")
    return read_spec(spec.file.path, settled(draws, spec.entries.fixed))


def _drawn(spec: Spec, arguments: Mapping[str, Any], seed: int) -> tuple[dict[str, Draw], list[str]]:
    takes: list[str] = []

    def run(forced: Forced, own_seed: int | None) -> Sequence[Record]:
        draws = {"values": forced, "seed": own_seed or seed, "middle": own_seed is None}
        answer = ask(spec, {"arguments": arguments, "out": "", "draws": draws})
        takes[:] = answer["takes"]
        return list(answer["draws"])

    texts: dict[str, str] = {}

    def site_of(record: Record) -> Site:
        file = record["file"]
        try:
            texts.setdefault(file, Path(file).read_text("utf-8"))
            return site(texts[file], (record["line"], record["column"]))
        except (OSError, UnicodeDecodeError, SyntaxError):  # made in memory, or of another Python
            return Site()

    return read_draws(run, site_of), takes

"""A geometry node group that is called as a function: a Blender beside this process evaluates it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import isclose
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.procedures.blender.installed import ADVICE, words
from shapewright.procedures.blender.script import script
from shapewright.procedures.blender.sockets import Socket, sockets_of
from shapewright.procedures.blender.usage import conditions
from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.facts import METRES, Facts
from shapewright.procedures.places import Place
from shapewright.procedures.procedure import Procedure
from shapewright.processes.external import words_of
from shapewright.processes.limits import memory_left
from shapewright.processes.resident import Answer, Gone, Resident
from shapewright.shapes import Mesh

_PROGRAM = Path(__file__).with_name("program.py")
_NO_MEMORY = ("alloc returns null", "bad_alloc", "MemoryError")
"""What Blender says last when it gets no memory."""
_TRIALS = 32
"""Random values at which the rules of when a socket matters are tried."""
_residents: dict[Path, Resident] = {}
"""The Blenders of this process, by the file that each has open: starting one takes a second."""


@dataclass(frozen=True, slots=True)
class NodeGroup:
    """A function from values of sockets, by their names in Python, to a mesh in Blender's axes.

    Attributes:
        file: the .blend file.
        group: the name of the node group.
        sockets: its inputs.
    """

    file: Path
    group: str
    sockets: tuple[Socket, ...]

    @property
    def __name__(self) -> str:
        return self.group

    @property
    def __signature__(self) -> inspect.Signature:
        return inspect.Signature([socket.parameter for socket in self.sockets])

    @property
    def own_names(self) -> dict[str, str]:
        """What people see the sockets called."""
        return {socket.argument: socket.name for socket in self.sockets}

    @property
    def place(self) -> Place:
        return Place(str(self.file), None)

    def __call__(self, **values: Any) -> Mesh:
        """Raises ProcedureError where there is no mesh, or Blender ends; MemoryError."""
        answer = self._ask(values, {"memory": memory_left()})
        if empty := answer.header.get("empty"):
            said = "; ".join(answer.header["warnings"])
            raise ProcedureError(_empty(*empty) + (f". Blender says: {said}" if said else ""), self.place)
        return _mesh(answer)

    def script(self, shapes: Mapping[str, Mapping[str, Any]]) -> str:
        """A script for Blender that makes an object for each of these values of sockets, by the shapes' names."""
        return script(self.group, self.sockets, shapes)

    def idle(self, values: Mapping[str, Any]) -> set[str]:
        """The sockets that change nothing at these values, as far as Blender tells. Raises ProcedureError."""
        at_rest = self._ask(values, {}).header["idle"]
        return {socket.argument for socket in self.sockets if socket.identifier in at_rest}

    def _ask(self, values: Mapping[str, Any], others: Mapping[str, Any]) -> Answer:
        known = {socket.argument: socket.identifier for socket in self.sockets}
        given = {known[name]: _plain(value) for name, value in values.items()}
        request = {"group": self.group, "values": given, **others}
        return _asked(lambda: _resident(self.file).ask(request), self.place)


def read(path: Path, name: str | None) -> Procedure:
    """The procedure of a node group of a file. name: of the group; a file with one group needs none.

    Raises ProcedureError when Blender is missing or cannot open the file, or no socket is a parameter.
    """
    place = Place(str(path), None)
    inside = _opened(path, place)
    groups: list[dict[str, Any]] = inside["groups"]
    names = [str(group["name"]) for group in groups]
    outer = [str(group["name"]) for group in groups if group["outer"]]
    if not names:
        raise ProcedureError("there is no geometry node group in it that gives a geometry", place)
    if name is None and len(outer) != 1:
        raise ProcedureError(
            f"several node groups ({', '.join(outer)}); say which: {path}:{(outer or names)[0]}", place
        )
    chosen = outer[0] if name is None else name
    if chosen not in names:
        raise ProcedureError(f"no node group {chosen!r} in it; there is {', '.join(names)}", place)
    sockets = sockets_of(next(group["sockets"] for group in groups if group["name"] == chosen))
    if all(socket.held for socket in sockets):
        why = "; ".join(f"{socket.name}: {socket.held}" for socket in sockets) or "it has none"
        raise ProcedureError(
            f"no socket of the group {chosen!r} is a parameter ({why}). Set Min and Max of its sockets: N, Group", place
        )
    group = NodeGroup(path, chosen, sockets)
    group = replace(group, sockets=_with_rules(group))
    made = Procedure(group, facts=_facts(inside, place))
    made.helpers = tuple(sorted(Path(file).resolve() for file in inside["files"]))
    return made


def _with_rules(group: NodeGroup) -> tuple[Socket, ...]:
    """Its sockets, with what is known of when they matter."""
    free = Procedure(group)
    vectors = free.space.sample(_TRIALS, seed=0)
    trials = [free.signature.call(dict, (), values) for values in vectors]
    rules = conditions(group.sockets, group.idle, trials)
    return tuple(replace(socket, when=rules.get(socket.argument)) for socket in group.sockets)


def _facts(inside: Mapping[str, Any], place: Place) -> Facts:
    unit = next((name for name, metres in METRES.items() if isclose(metres, inside["scale"], rel_tol=1e-3)), "m")
    try:
        return Facts.written(inside["facts"], {"up": "z", "unit": unit})
    except ValueError as error:
        raise ProcedureError(f"the text-block 'shapewright': {error}", place) from error


def _opened(path: Path, place: Place) -> Mapping[str, Any]:
    """What is in a file, opened anew."""

    def ask() -> Answer:
        resident = _residents.get(path)
        return resident.ask({"open": str(path)}) if resident and resident.alive else _resident(path).first

    return _asked(ask, place).header


def _resident(file: Path) -> Resident:
    resident = _residents.get(file)
    if resident is None or not resident.alive:
        resident = _residents[file] = Resident(words(_PROGRAM), {"open": str(file)})
    return resident


def _asked(ask: Callable[[], Answer], place: Place) -> Answer:
    """An answer that is none of failure. Raises ProcedureError; MemoryError."""
    try:
        answer = ask()
    except OSError as error:
        raise ProcedureError(f"Blender does not start: {error}", place) from error
    except Gone as error:
        last = error.ended.last_words
        if any(sign in last for sign in _NO_MEMORY):
            raise MemoryError from error
        how = f"Blender ended ({words_of(error.ended.status or 0)})"
        limited = "" if memory_left() is None else "; a limit of memory can be the reason: shape_memory_mb"
        raise ProcedureError((f"{last}: {how}" if last else how) + limited, place, "crash") from error
    if answer.header.get("lost") == "memory":
        raise MemoryError
    if answer.header.get("lost") == "module":
        raise ProcedureError(f"{words(_PROGRAM)[0]} has no module {answer.header['name']}. {ADVICE}", place)
    if said := answer.header.get("error"):
        raise ProcedureError(f"Blender says: {said}", place)
    return answer


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    return [_plain(part) for part in value] if isinstance(value, tuple | list) else value


def _empty(vertices: int, edges: int) -> str:
    if edges:
        return f"the mesh has {edges} edges and no face: curves need a Curve to Mesh node with a profile"
    return f"the mesh has {vertices} points and no face" if vertices else "the group gives no mesh at these values"


def _mesh(answer: Answer) -> Mesh:
    """Labels are the named attributes; a face without one has the name of its material."""
    header: Mapping[str, Any] = answer.header
    arrays = answer.arrays
    named: list[str] = header["labels"]
    materials: list[str] = header["materials"]
    slots = arrays["face_materials"]
    labels = np.where(arrays["face_labels"] >= 0, arrays["face_labels"], np.where(slots >= 0, slots + len(named), -1))
    used = np.unique(labels[labels >= 0])
    every = [*named, *materials]
    names = tuple(dict.fromkeys(every[i] for i in used))
    number = np.full(len(every) + 1, -1)
    number[used] = [names.index(every[i]) for i in used]
    colours = np.array([*header["colours"], [0.0] * 4])[slots]
    return Mesh(
        arrays["vertices"],
        arrays["faces"],
        number[labels] if names else None,
        names,
        face_colours=_srgb(colours) if (slots >= 0).any() else None,
    )


def _srgb(linear: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """(F, 4) uint8 of linear colours (IEC 61966-2-1)."""
    colour = linear.clip(0.0, 1.0)
    shown = np.where(colour <= 0.0031308, 12.92 * colour, 1.055 * colour ** (1.0 / 2.4) - 0.055)
    shown[:, 3] = colour[:, 3]
    return np.asarray(np.round(255.0 * shown), dtype=np.uint8)

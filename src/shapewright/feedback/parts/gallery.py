"""Surfaces of the library's rules with sampled parameters, kept on disk: they are slower to make than to compare."""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from shapewright import modelling, rules
from shapewright.comparison.surfaces import Samples, sample
from shapewright.parameters import Parameters
from shapewright.rules import bundled
from shapewright.rules.rule import Rule
from shapewright.shapes import Floats
from shapewright.storage import whole_file

ASPECT = 2.5
"""Ratio of sides from one surface of a rule to the next; between them it is stretched."""
SAMPLES = 6
"""Parameters that each rule is made with; the first are its defaults."""
_POINTS = 150  # of a surface
_DAMAGED = (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile)

Key: TypeAlias = tuple[str, int, int, int]
"""Name of a rule; its height and depth in units of its width, as powers of ASPECT; number of its parameters."""


@dataclass(frozen=True, eq=False)
class Form:
    """The surface of a rule.

    Attributes:
        size: (3,), of the box that it fills, about the origin.
        samples: of its surface.
    """

    size: Floats
    samples: Samples


@dataclass(eq=False)
class Gallery:
    """Forms of rules, as far as they are known by now.

    Attributes:
        folder: where those of bundled rules are kept; None to keep none.
    """

    folder: Path | None
    _forms: dict[Key, Form | None] = field(default_factory=dict)
    _on_disk: int = 0

    @classmethod
    def opened(cls, folder: Path | None) -> Gallery:
        """With what a folder holds; a damaged file counts as none."""
        try:
            forms = _read(folder / _file_name()) if folder else {}
        except _DAMAGED:
            forms = {}
        return cls(folder, forms, len(forms))

    def form(self, rule: Rule, aspect: tuple[int, int], number: int) -> tuple[Parameters, Form] | None:
        """Sampled parameters of a rule and its surface; None where there are no more, or it cannot be made."""
        drawn = _drawn(rule)
        if number >= len(drawn):
            return None
        key = (_qualified(rule), *aspect, number)
        if key not in self._forms:
            form = form_of(rule, _size(*aspect), drawn[number])
            self._forms[key] = form and Form(form.size, _rounded(form.samples))
        found = self._forms[key]
        return (dict(drawn[number]), found) if found else None

    def keep(self) -> None:
        """Put what is new on disk. What cannot be written is made again another time."""
        kept = {key: form for key, form in list(self._forms.items()) if key[0].startswith(bundled.__name__)}
        if self.folder and len(kept) > self._on_disk:
            try:
                self.folder.mkdir(parents=True, exist_ok=True)
                _write(self.folder / _file_name(), kept)
            except OSError:
                return


def form_of(rule: Rule, size: Floats, arguments: Mapping[str, Any]) -> Form | None:
    """None where the rule makes nothing of this size."""
    try:
        return Form(size, sample(rule(size, **arguments).mesh(), _POINTS))
    except ValueError:
        return None


def _size(tall: int, deep: int) -> Floats:
    return np.array([1.0, ASPECT**tall, ASPECT**deep])


def _qualified(rule: Rule) -> str:
    return f"{rule.function.__module__}.{rule.name}"


@lru_cache(maxsize=1024)
def _drawn(rule: Rule) -> tuple[Parameters, ...]:
    return (rule.space.defaults, *(rule.space.sample(SAMPLES - 1, 0) if len(rule.space) else ()))


def _rounded(samples: Samples) -> Samples:
    """As a file keeps them: what is read later is what was made first."""
    points, normals = (each.astype(np.float32).astype(np.float64) for each in (samples.points, samples.normals))
    return Samples(points, samples.faces, normals, samples.area)


@lru_cache(maxsize=1)
def _file_name() -> str:
    """It names the text of the rules and of the kit that they are written with."""
    homes = [Path(room.__path__[0]) for room in (modelling, rules)]
    text = b"".join(path.read_bytes() for home in homes for path in sorted(home.rglob("*.py")))
    return f"rules-{_POINTS}-{hashlib.sha256(text).hexdigest()[:20]}.npz"


def _write(path: Path, forms: Mapping[Key, Form | None]) -> None:
    """A surface without area stands for one that cannot be made."""
    none = Samples(np.zeros((_POINTS, 3)), np.zeros(_POINTS, np.int64), np.zeros((_POINTS, 3)), 0.0)
    samples = [form.samples if form else none for form in forms.values()]
    with whole_file(path) as partial, partial.open("wb") as file:
        np.savez(
            file,
            names=np.array([key[0] for key in forms]),
            numbers=np.array([key[1:] for key in forms]),
            points=np.array([each.points for each in samples], dtype=np.float32),
            normals=np.array([each.normals for each in samples], dtype=np.float32),
            areas=np.array([each.area for each in samples]),
        )


def _read(path: Path) -> dict[Key, Form | None]:
    with np.load(path, allow_pickle=False) as file:
        names, numbers = file["names"], file["numbers"]
        points, normals = (file[name].astype(np.float64) for name in ("points", "normals"))
        areas = file["areas"]
    faces = np.zeros(_POINTS, np.int64)
    forms: dict[Key, Form | None] = {}
    for row, name in enumerate(names):
        tall, deep, number = (int(value) for value in numbers[row])
        samples = Samples(points[row], faces, normals[row], float(areas[row]))
        forms[str(name), tall, deep, number] = Form(_size(tall, deep), samples) if areas[row] else None
    return forms

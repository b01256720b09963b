"""STEP and IGES: surfaces that OpenCASCADE divides into triangles, with the names of parts."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.scene import read_gltf
from shapewright.references.readers.scene_parts import Scene
from shapewright.references.readers.text import PADDING

_CHORD, _ANGLE = 0.01, 0.25
"""How far a triangle may be from the surface, as a share of its edge, and how far two may lean, in radians: a circle
has 25 sides or more, whatever its size."""
_COMMENT = re.compile(rb"/\*.*?\*/|'(?:[^']|'')*'", re.DOTALL)
_ENTITY = re.compile(rb"#(\d+)\s*=")
_REFERENCE = re.compile(rb"#(\d+)(?!\s*=)(?!\d)")
_TERMINATE = re.compile(rb"S\s*(\d+)G\s*(\d+)D\s*(\d+)P\s*(\d+)")
_WIDTH = 72  # the column of an IGES line that tells its section
_SHOWN = 5
_DECORATION = re.compile(r"\x1b\[[\d;]*m|\*+")
_HEARD = 100_000
_MILLIMETRE = 1e-3  # of IGES cascadio 0.1.1 gives these, of STEP metres (measured on boxes in millimetres and inches)


def read_step(_: Path, data: bytes) -> Scene:
    """The triangles of a STEP file's bytes, in metres. Raises UnreadableError, with the reason."""
    text = data.rstrip(PADDING)
    if not text.lstrip().startswith(b"ISO-10303-21"):
        raise UnreadableError("no STEP: it does not begin with ISO-10303-21")
    if not text.endswith(b"END-ISO-10303-21;"):
        raise UnreadableError("broken: cut short, it does not end with END-ISO-10303-21")
    bare = _COMMENT.sub(b"", text)
    missing = sorted({int(n) for n in _REFERENCE.findall(bare)} - {int(n) for n in _ENTITY.findall(bare)})
    if missing:
        shown = ", ".join(f"#{number}" for number in missing[:_SHOWN])
        raise UnreadableError(f"broken: it refers to {shown}{', ...' * (len(missing) > _SHOWN)}, not there")
    return _divided(data, "step", "STEP", 1.0)


def read_iges(_: Path, data: bytes) -> Scene:
    """The triangles of an IGES file's bytes, in millimetres. Raises UnreadableError, with the reason."""
    lines = [line for line in data.rstrip(PADDING).splitlines() if line.strip(PADDING)]
    sections = [line[_WIDTH : _WIDTH + 1] for line in lines]
    last = _TERMINATE.match(lines[-1]) if lines else None
    if last is None or sections[-1] != b"T":
        raise UnreadableError("broken: no IGES in lines of 80 letters, or cut short: its last line counts no others")
    for section, told in zip((b"S", b"G", b"D", b"P"), last.groups(), strict=True):
        if sections.count(section) != int(told):
            found = sections.count(section)
            raise UnreadableError(
                f"broken: it announces {int(told)} lines of section {section.decode()}, but has {found}"
            )
    return _divided(data, "iges", "IGES", _MILLIMETRE)


@contextmanager
def _listening(said: list[str]) -> Iterator[None]:
    """Within it nothing is printed; ``said`` has it at the end. OpenCASCADE tells there alone that a file is broken."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(number) for number in (1, 2)]
    with tempfile.TemporaryFile() as heard:
        try:
            for number in (1, 2):
                os.dup2(heard.fileno(), number)
            yield
        finally:
            for number, copy in zip((1, 2), kept, strict=True):
                os.dup2(copy, number)
                os.close(copy)
            heard.seek(0)
            said += heard.read(_HEARD).decode("utf-8", "replace").splitlines()


def _divided(data: bytes, kind: Literal["step", "iges"], name: str, unit: float) -> Scene:
    try:
        import cascadio
    except ImportError as error:
        raise UnreadableError(f"{name}, which needs cascadio: pip install 'shapewright[cad]'") from error
    said: list[str] = []
    with _listening(said):
        packed = cascadio.load(
            data, file_type=kind, tol_linear=_CHORD, tol_angular=_ANGLE, tol_relative=True, use_parallel=False
        )
    wrong = next((line for line in said if "ERR" in line), None)
    if wrong is not None:
        raise UnreadableError(f"broken: OpenCASCADE says {' '.join(_DECORATION.sub(' ', wrong).split())}")
    if not packed:
        raise UnreadableError("broken: OpenCASCADE finds no shape in it")
    scene = read_gltf(Path("divided.glb"), packed)
    return Scene(scene.vertices, scene.faces, scene.notes, unit, parts=scene.parts)

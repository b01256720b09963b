"""The program that calls a function in another Python, which has no shapewright; see ``processes.resident``.

It uses what Python 3.8 has, and nothing else. The first request says what is called; a further one has ``arguments``,
and ``out``, an OBJ file to write. An answer has ``file``, the file that holds the shape, and ``up``, the axis that
points up in it where the library has one; or ``error``, and ``missing``, the package that is not there. With
``draws``, random draws of procfunc have values; without ``out``, an answer has ``draws``, what was drawn.
"""

from __future__ import annotations

import contextlib
import functools
import importlib
import importlib.util
import inspect
import json
import os
import re
import struct
import sys
import traceback
from pathlib import Path
from typing import Any

HELLO = b"\0shapewright\0"
FOLDER = Path(__file__).resolve().with_name("procfunc")


def main() -> None:
    """Answer requests until there are no more."""
    requests, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what the function prints is no answer
    answers.write(HELLO)
    function = None
    while head := requests.read(4):
        request = json.loads(requests.read(struct.unpack(">I", head)[0]))
        answer: dict[str, Any] = {"arrays": []}
        try:
            if function is None:
                function = found(**request)
            else:
                answer.update(built(function, **request))
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever it raises is an answer
            place = traceback.extract_tb(error.__traceback__)[-1]
            if isinstance(error, ImportError):
                answer["missing"] = str(error.name).partition(".")[0]
            answer["error"] = f"{type(error).__name__}: {error} ({place.filename}:{place.lineno})"
        text = json.dumps(answer).encode()
        answers.write(struct.pack(">I", len(text)) + text)
        answers.flush()


def found(target: str, home: str, environment: dict[str, str]) -> Any:
    """The function ``module:name``; modules of the folder ``home`` are found, too."""
    os.environ.update(environment)
    sys.path[0] = home
    module, _, name = target.partition(":")
    return functools.reduce(getattr, name.split("."), importlib.import_module(module))


def built(function: Any, arguments: dict[str, Any], out: str, draws: Any = None) -> dict[str, Any]:
    """The answer to a request. What Blender holds of it is removed."""
    with beside("meshes").removed_afterwards() if "bpy" in sys.modules else contextlib.nullcontext():
        if draws is not None:
            result, records = beside("draws").called(function, arguments, **draws)
            if not out:
                return {"draws": records, "takes": list(inspect.signature(function).parameters)}
        else:
            result = function(**arguments)
        objects = beside("meshes").objects_of(result) if "bpy" in sys.modules else []
        if objects:
            return {"file": beside("meshes").written(objects, out), "up": "z"}
        return {"file": written(result, out)}


@functools.lru_cache(None)
def beside(name: str) -> Any:
    """A module of the folder procfunc, which only what uses Blender needs."""
    spec: Any = importlib.util.spec_from_file_location(f"shapewright_{name}", f"{FOLDER}/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def written(result: Any, out: str) -> str:
    """The file of a shape: what exports itself, vertices and faces, or the path of a file that was written."""
    if isinstance(result, str) or hasattr(result, "__fspath__"):
        return str(Path(result).absolute())
    if hasattr(result, "as_trimesh_scene"):  # an asset of scene_synthesizer, whose parts have its name before theirs
        result.as_trimesh_scene(namespace="asset", use_collision_geometry=False).export(out)
        Path(out).write_text(re.sub("^([og]) asset/", r"\1 ", Path(out).read_text(), flags=re.MULTILINE))
        return out
    if hasattr(result, "export"):
        result.export(out)
        return out
    vertices, faces = (result.vertices, result.faces) if hasattr(result, "faces") else result
    lines = ["v " + " ".join(str(float(x)) for x in vertex) for vertex in vertices]
    lines += ["f " + " ".join(str(int(i) + 1) for i in face) for face in faces]
    Path(out).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return out


if __name__ == "__main__":
    main()

"""Which files a USD stage is composed of. Nothing outside its folder is opened."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from shapewright.references.errors import UnreadableError

_MOST = 1000
"""Layers of a stage."""
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*://|\$\{|`")
_SHOWN = 200
_LOOKS = ".mtlx"
"""How the names of layers end that hold materials alone."""


def check_layers(sdf: Any, path: Path) -> Any:
    """The root layer of a stage, after a look at all that it refers to. ``sdf`` is the module ``pxr.Sdf``.

    Raises UnreadableError for a layer that lies elsewhere, is missing, or cannot be read.
    """
    folder = path.parent.resolve()
    root = _opened(sdf, str(path), path.name)
    seen, waiting = {root.identifier}, [root]
    while waiting:
        layer = waiting.pop()
        for asset in sorted(layer.GetCompositionAssetDependencies()):
            if not asset or asset.lower().endswith(_LOOKS):
                continue
            where = layer.ComputeAbsolutePath(asset)
            if not Path(where.partition("[")[0]).is_absolute():  # one that is looked for, and not found
                where = str(Path(layer.realPath.partition("[")[0]).parent / asset)
            _check(asset, where, folder)
            if where in seen:
                continue
            seen.add(where)
            if len(seen) > _MOST:
                raise UnreadableError(f"it refers to more than {_MOST:,} layers")
            waiting.append(_opened(sdf, where, asset))
    return root


def _check(asset: str, where: str, folder: Path) -> None:
    outermost = Path(where.partition("[")[0])
    if _SCHEME.match(asset) or not outermost.resolve().is_relative_to(folder):
        raise UnreadableError(f"it refers to {asset[:_SHOWN]}, which lies outside its folder")
    if not outermost.is_file():
        raise UnreadableError(f"it needs {asset[:_SHOWN]}, which is missing")


def _opened(sdf: Any, where: str, asset: str) -> Any:
    try:
        layer = sdf.Layer.FindOrOpen(where)
    except Exception as error:  # of a type of the library's own
        raise UnreadableError(f"broken: {asset[:_SHOWN]} is not read as USD: {told(error)}") from error
    if layer is None:
        raise UnreadableError(f"broken: {asset[:_SHOWN]} is not read as USD")
    return layer


def told(error: Exception) -> str:
    """What an error of the library tells, without where in its code it was."""
    try:
        first = str(error).strip().partition("\n")[0]
    except UnicodeError:  # it quotes what it finds
        return "it has text that is not UTF-8"
    return first.rpartition(" : '")[2].rstrip("' ")[-_SHOWN:]

"""Versions of the packages on which results depend."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

VERSIONED = ("shapewright", "numpy", "torch", "numba", "manifold3d", "scikit-learn", "trimesh")
UNKNOWN = "unknown"
"""The version of what is not installed, as shapewright where it runs from its sources: no reason to lose a run."""


def version_of(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return UNKNOWN


def versions() -> dict[str, str]:
    """Of Python, and of each package."""
    return {"python": platform.python_version(), **{name: version_of(name) for name in VERSIONED}}

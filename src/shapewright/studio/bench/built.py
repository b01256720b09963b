"""What a builder process tells its bench: the version of the procedure that it read, and every shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from shapewright.building.outcomes import Build
from shapewright.parameters import Parameters


@dataclass(frozen=True)
class Version:
    """A procedure that was read: its name, its parameters as plain values, and their defaults."""

    name: str
    parameters: list[dict[str, Any]]
    defaults: Parameters


@dataclass(frozen=True)
class Built:
    """A build, the names of the parameters that matter there, and of those at an end of their Range."""

    build: Build
    active: tuple[str, ...] = ()
    at_limit: tuple[str, ...] = ()

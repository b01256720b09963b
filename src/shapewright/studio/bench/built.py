"""What a builder process answers: the version of the procedure that it read, and every shape."""

from __future__ import annotations

from dataclasses import dataclass

from shapewright.building.outcomes import Build
from shapewright.parameters import Parameters
from shapewright.studio.wire.collection import Parameter


@dataclass(frozen=True)
class Version:
    """A procedure that was read."""

    name: str
    parameters: list[Parameter]  # as the page gets them
    defaults: Parameters


@dataclass(frozen=True)
class Built:
    """A shape that was built, or could not be."""

    build: Build
    active: tuple[str, ...] = ()  # names of the parameters that matter there
    at_limit: tuple[str, ...] = ()  # names of those at an end of their Range

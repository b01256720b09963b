"""Building many shapes in worker processes that a bad procedure cannot take down with it."""

from shapewright.building.outcomes import Build, Failure, FailureKind, Limits, commonest_place, describe_failures
from shapewright.building.pool import Workers, build_all
from shapewright.threads import cores

__all__ = [
    "Build",
    "Failure",
    "FailureKind",
    "Limits",
    "Workers",
    "build_all",
    "commonest_place",
    "cores",
    "describe_failures",
]

"""Building many shapes in worker processes that a bad procedure cannot take down with it."""

from shapewright.building.executors import Executor, ExecutorError
from shapewright.building.opened import Opened, is_own
from shapewright.building.outcomes import Build, Failure, commonest_place, describe_failures
from shapewright.building.pool import Workers
from shapewright.building.sites import Crew
from shapewright.processes import Limits

__all__ = [
    "Build",
    "Crew",
    "Executor",
    "ExecutorError",
    "Failure",
    "Limits",
    "Opened",
    "Workers",
    "commonest_place",
    "describe_failures",
    "is_own",
]

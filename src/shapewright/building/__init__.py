"""Building many shapes in worker processes that a bad procedure cannot take down with it."""

from shapewright.building.outcomes import Build, Failure, commonest_place, describe_failures
from shapewright.building.pool import Workers
from shapewright.processes import Limits

__all__ = ["Build", "Failure", "Limits", "Workers", "commonest_place", "describe_failures"]

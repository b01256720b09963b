"""The light field distance: how much two shapes differ to the eye, over all rotations (Chen et al. 2003)."""

from shapewright.comparison.light_field.description import Descriptor
from shapewright.comparison.light_field.pairs import (
    RAW_SCALE,
    THRESHOLD,
    descriptor,
    descriptors,
    distance,
    distances,
    raw_distance,
    raw_distances,
)

__all__ = [
    "RAW_SCALE",
    "THRESHOLD",
    "Descriptor",
    "descriptor",
    "descriptors",
    "distance",
    "distances",
    "raw_distance",
    "raw_distances",
]

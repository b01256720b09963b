"""Collections of references: found, read, turned Y up, centred and scaled."""

from shapewright.references.collection import Collection
from shapewright.references.errors import CollectionError
from shapewright.references.orientation import Orientation
from shapewright.references.readers.formats import EXTENSIONS
from shapewright.references.reference import Reference

__all__ = ["EXTENSIONS", "Collection", "CollectionError", "Orientation", "Reference"]

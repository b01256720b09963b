"""Programs that make shapes: what their spec says, how they are run, and the file that they leave."""

from shapewright.commands.reading import read
from shapewright.commands.spec import Spec, read_spec

__all__ = ["Spec", "read", "read_spec"]

"""Scans cleaned: a floor taken off, stray points left out, density evened, normals found."""

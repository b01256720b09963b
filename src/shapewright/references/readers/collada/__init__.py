"""COLLADA: the triangles that its scene shows."""

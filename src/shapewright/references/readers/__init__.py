"""Readers of files: the triangles or the drawing that each holds."""

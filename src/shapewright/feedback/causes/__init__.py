"""Causes: why a procedure does not replicate a reference."""

"""Comparison: how much two shapes differ."""

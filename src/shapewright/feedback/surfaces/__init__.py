"""Surfaces of replica and reference, and where they differ."""

"""Judging: whether a replica stands for its reference."""

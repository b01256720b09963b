"""Runs: a finished turn of the loop, and its folder on disk."""

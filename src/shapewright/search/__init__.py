"""Searching for parameters on the procedure itself, by what still differs."""

"""Feedback: an iteration explained, and what to write next."""

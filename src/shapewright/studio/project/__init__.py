"""The author's project on disk."""

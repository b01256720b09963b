"""The bench: the process that builds, draws and measures for the page."""

"""Paints, layers of what is painted, and the cells on which they are laid over one another."""

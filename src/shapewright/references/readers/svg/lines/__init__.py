"""Paths, the basic shapes as paths, and the areas that pens cover along them."""

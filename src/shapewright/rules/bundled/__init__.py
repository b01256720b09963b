"""Rules that come with shapewright, a module for each kind of thing."""

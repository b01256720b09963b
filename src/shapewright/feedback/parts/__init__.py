"""Parts: of which shapes consist, and pieces that could be added to them."""

"""First procedures of a project, one for each kind; `shapewright new` copies them."""

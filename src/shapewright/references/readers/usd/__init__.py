"""USD, through usd-core (extra ``usd``): the triangles that a stage shows."""

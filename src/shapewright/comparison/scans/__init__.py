"""How a replica differs from points that are seen from some sides only."""

"""Whether a replica stands for points that were seen from some sides only."""

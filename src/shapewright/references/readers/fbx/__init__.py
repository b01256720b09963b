"""FBX, binary and text: the triangles that its scene shows."""

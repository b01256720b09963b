"""3MF packages: the triangles of what their build section lists, where it places them."""

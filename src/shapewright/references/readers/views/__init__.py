"""Pictures of objects, read as views: what of them is the object."""

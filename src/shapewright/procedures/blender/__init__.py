"""Geometry nodes of Blender as procedures: sockets are parameters, and a Blender beside this process builds."""

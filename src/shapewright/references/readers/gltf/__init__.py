"""Scenes in glTF 2.0, as text (.gltf) or binary (.glb): the triangles that they show, before any motion."""

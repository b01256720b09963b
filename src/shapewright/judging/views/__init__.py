"""Pictures of an object as references of meshes, each from the camera that suits a replica best."""

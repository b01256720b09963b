"""The cameras of pictures: from where a mesh looks as a picture shows its object."""

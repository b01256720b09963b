"""The studio: a local page where the author sees what the procedure cannot do yet."""

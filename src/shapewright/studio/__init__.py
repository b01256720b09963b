"""The studio: a local web page where the author sees what the procedure cannot do yet; PROTOCOL.md is its language."""

"""Writing: changes of the author's file."""

"""Parameters of many shapes, listed in the builder: conditions of parameters are the author's code."""

"""Ideas: changes of a procedure that could help."""

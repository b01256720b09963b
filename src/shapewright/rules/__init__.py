"""Rules that other procedures know: parts with a name and parameters, and the box that each fills."""

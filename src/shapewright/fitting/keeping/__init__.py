"""What is done of a fit that is not finished, kept in a folder."""

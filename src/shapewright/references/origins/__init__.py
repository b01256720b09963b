"""Where references are told to be: lists of paths, and addresses of other machines."""

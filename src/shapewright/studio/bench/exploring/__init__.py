"""Many shapes of the procedure, beside or without references."""

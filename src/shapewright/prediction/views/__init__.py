"""Learning to predict from pictures of objects."""

"""Prediction: from pictures of a shape to the parameters of a procedure."""

"""Trials: changed procedures, tried on the references."""

"""Fitting: one turn of the loop, stage after stage."""

"""The modelling kit: what procedures are written with."""

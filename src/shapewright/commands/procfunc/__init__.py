"""Functions of procfunc and Infinigen 2: what they return, and the space that their random draws are."""

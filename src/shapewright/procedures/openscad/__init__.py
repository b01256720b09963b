"""OpenSCAD files as procedures: the Customizer's annotations are the parameter space."""

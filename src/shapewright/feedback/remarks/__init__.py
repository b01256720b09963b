"""Remarks: what an author would say of a difference, as facts first and then in words."""

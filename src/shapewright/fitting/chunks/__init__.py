"""Fits of many references: chunk after chunk, of which each is kept when it is done."""

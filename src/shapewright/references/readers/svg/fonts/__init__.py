"""Fonts, by whose outlines text of SVG is drawn."""

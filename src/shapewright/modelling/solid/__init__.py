"""Solids: closed volumes with labelled parts."""

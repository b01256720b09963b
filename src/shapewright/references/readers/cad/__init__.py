"""Exact solids of CAD programs, through cascadio (extra ``cad``), as triangles."""

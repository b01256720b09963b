"""Exact solids of CAD programs as triangles and their drawings as areas, through cascadio and ezdxf (extra ``cad``)."""

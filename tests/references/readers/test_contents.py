import io

import pytest
from PIL import Image

import boxes
from benches import bench
from shapewright.references.readers.contents import held


def picture(kind: str) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(bench()).save(buffer, kind)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (picture("PNG"), "a PNG"),
        (picture("JPEG"), "a JPEG"),
        (picture("WEBP"), "a WebP"),
        (picture("TIFF"), "a TIFF"),
        (picture("BMP"), "a BMP"),
        (b"\0\0\0\x18ftypheic", "a HEIC"),
        (b"\n <!DOCTYPE HTML>\n<html>", "a web page"),
        (b"\xef\xbb\xbf<?xml version='1.0'?>\n<!-- by hand -->\n<svg>", "an SVG"),
        (b"<?xml version='1.0'?>\n<COLLADA>", "a Collada file"),
        (b"<?xml version='1.0'?>\n<x3d>", "XML"),
        (boxes.ply().encode(), "a PLY"),
        (boxes.off().encode(), "an OFF"),
        (boxes.stl().encode(), "an STL"),
        (boxes.obj().encode(), "text"),
        ("Stühle".encode(), "text"),
        (b"", "unknown data"),
        (b"\0\1\2", "unknown data"),
    ],
)
def test_first_bytes_tell_the_kind(data, kind):
    assert held(data) == kind

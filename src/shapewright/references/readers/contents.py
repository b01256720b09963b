"""What a file holds: its shape with what the file states of it, and its kind, told by its first bytes."""

from __future__ import annotations

import re
from dataclasses import dataclass

from shapewright.shapes import ReferenceShape


@dataclass(frozen=True, eq=False)
class Contents:
    """What a reader finds in a file.

    Attributes:
        shape: the triangles in one mesh, the points, or the drawing, in the file's own units and axes.
        notes: what of the file was left out.
        unit: the unit of the shape in metres, where the file or its format states it; else None.
        up: the axis that points up, among x, y, z, -x, -y, -z, where the file or its format states it; else None.
    """

    shape: ReferenceShape
    notes: tuple[str, ...] = ()
    unit: float | None = None
    up: str | None = None


_SIGNS: tuple[tuple[bytes, str], ...] = (
    (rb"\x89PNG", "a PNG"),
    (rb"\xff\xd8\xff", "a JPEG"),
    (rb"RIFF....WEBP", "a WebP"),
    (rb"GIF8", "a GIF"),
    (rb"II\*\0|MM\0\*", "a TIFF"),
    (rb"....ftypavi[fs]", "an AVIF"),
    (rb"....ftyp(?:heic|heix|mif1)", "a HEIC"),
    (rb"\0\0\0\x0cjP|\xff\x4f\xff\x51", "a JPEG 2000"),
    (rb"8BPS", "a Photoshop file"),
    (rb"BM.{4}\0{4}", "a BMP"),
    (rb"%PDF", "a PDF"),
    (rb"%!PS", "PostScript"),
    (rb"PK\x03\x04|PK\x05\x06", "a ZIP archive"),
    (rb"\x1f\x8b", "a gzip archive"),
    (rb"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (rb"Rar!", "a RAR archive"),
    (rb"BZh", "a bzip2 archive"),
    (rb"\xfd7zXZ\0", "an xz archive"),
    (rb".{257}ustar", "a tar archive"),
    (rb"glTF", "a binary glTF"),
    (rb"Kaydara FBX Binary", "an FBX"),
    (rb"; FBX", "an FBX"),
    (rb"BLENDER", "a Blender file"),
    (rb"ISO-10303-21", "a STEP file"),
    (rb"PXR-USDC|#usda", "USD"),
    (rb"#VRML", "VRML"),
    (rb"\s*(?:<!--.*?-->\s*)*<!DOCTYPE html|\s*(?:<!--.*?-->\s*)*<html", "a web page"),
    (rb"\s*(?:<\?xml.*?>\s*)?(?:<!--.*?-->\s*)*(?:<!DOCTYPE svg.*?>\s*)?<svg", "an SVG"),
    (rb"\s*(?:<\?xml.*?>\s*)?(?:<!--.*?-->\s*)*<COLLADA", "a Collada file"),
    (rb"\s*<", "XML"),
    (rb"ply\s", "a PLY"),
    (rb"LASF", "a LAS"),
    (rb"ASTM-E57", "an E57"),
    (rb"# \.PCD|VERSION [.0]*7", "a PCD"),
    (rb"\s*(?:ST|C|N|4|n)*OFF\s", "an OFF"),
    (rb"\s*solid\s", "an STL"),
    (rb"\s*[{\[]", "JSON"),
)
_LOOKED_AT = 1024
_MARK = b"\xef\xbb\xbf"


def held(data: bytes) -> str:
    """The kind of file that bytes hold, with its article, such as "a JPEG"; "text" or "unknown data" for any other."""
    start = data[:_LOOKED_AT].removeprefix(_MARK)
    for sign, kind in _SIGNS:
        if re.match(sign, start, re.DOTALL | re.IGNORECASE if sign.isascii() and b"<" in sign else re.DOTALL):
            return kind
    printable = sum(byte >= ord(" ") or byte in b"\t\r\n\f" for byte in start)
    return "text" if start and printable == len(start) and b"\x7f" not in start else "unknown data"

"""Small 3MF packages, made from text."""

import io
import zipfile
from pathlib import Path

from gltf_files import CUBE, CUBE_FACES

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
BEAMS = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
SLICES = "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07"
MODEL = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"


def mesh(vertices=CUBE, faces=CUBE_FACES, more: str = "") -> str:
    corners = "".join(f'<vertex x="{x:g}" y="{y:g}" z="{z:g}"/>' for x, y, z in vertices)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces)
    return f"<mesh><vertices>{corners}</vertices><triangles>{triangles}</triangles>{more}</mesh>"


def object_(number: int, content: str, attributes: str = "") -> str:
    return f'<object id="{number}" {attributes}>{content}</object>'


def components(*attributes: str) -> str:
    return f"<components>{''.join(f'<component {each}/>' for each in attributes)}</components>"


def model(resources: str, *items: str, attributes: str = "") -> str:
    """The XML of a model part; each item is the attributes of one."""
    build = "".join(f"<item {item}/>" for item in items)
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<model xmlns="{CORE}" xmlns:p="{PRODUCTION}" {attributes}>'
        f"<resources>{resources}</resources><build>{build}</build></model>"
    )


def moved(x: float, y: float = 0.0, z: float = 0.0) -> str:
    return f'transform="1 0 0 0 1 0 0 0 1 {x} {y} {z}"'


def relations(*targets: str, more: str = "") -> str:
    found = "".join(f'<Relationship Target="{target}" Id="r" Type="{MODEL}" {more}/>' for target in targets)
    return (
        f'<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">{found}</Relationships>'
    )


def archive(parts: dict[str, str | bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in parts.items():
            file.writestr(name, content)
    return stream.getvalue()


def single(xml: str | bytes) -> bytes:
    """A package with one model part."""
    return archive({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": xml})


def written(folder: Path, data: bytes) -> Path:
    path = folder / "a.3mf"
    path.write_bytes(data)
    return path

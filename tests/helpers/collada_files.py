"""Small COLLADA files, made from text."""

from gltf_files import CUBE, CUBE_FACES


def numbers(values) -> str:
    return " ".join(f"{value:g}" for value in values)


def source(name: str, values, width: int = 3, kind: str = "float_array") -> str:
    """A source of numbers or of words in rows of this width."""
    values = [value for row in values for value in (row if width > 1 else [row])]
    text = " ".join(values) if kind != "float_array" else numbers(values)
    return (
        f'<source id="{name}"><{kind} id="{name}-a" count="{len(values)}">{text}</{kind}><technique_common>'
        f'<accessor source="#{name}-a" count="{len(values) // width}" stride="{width}"/></technique_common></source>'
    )


def triangles(faces=CUBE_FACES) -> str:
    indices = numbers(corner for face in faces for corner in face)
    return (
        f'<triangles count="{len(faces)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles>'
    )


def geometry(name: str = "box", vertices=CUBE, primitives: str | None = None) -> str:
    """A geometry of one mesh, by default a cube; inputs of its primitives refer to #v, which they need not do truly."""
    shape = triangles() if primitives is None else primitives
    return (
        f'<geometry id="{name}"><mesh>{source(name + "-p", vertices)}<vertices id="{name}-v">'
        f'<input semantic="POSITION" source="#{name}-p"/></vertices>{shape}</mesh></geometry>'
    )


def show(name: str = "box") -> str:
    return f'<instance_geometry url="#{name}"/>'


def document(nodes: str, geometries: str | None = None, more: str = "", asset: str = "") -> bytes:
    """A document whose scene has these nodes."""
    return (
        '<?xml version="1.0" encoding="utf-8"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
        f'version="1.4.1"><asset>{asset}</asset><library_geometries>{geometry() if geometries is None else geometries}'
        f"</library_geometries>{more}<library_visual_scenes><visual_scene id='s'>{nodes}</visual_scene>"
        "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>"
    ).encode()

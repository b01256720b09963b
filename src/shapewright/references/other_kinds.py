"""Files of shapes that are not read: what each kind is called, and the way out of it."""

from __future__ import annotations

from pathlib import Path

_BLENDER = "open it in Blender and export it as GLB or OBJ"
_CAD = "export it from a CAD program, such as FreeCAD, as STL or 3MF"
_OWN = "export it from its own program as GLB, OBJ or STL"
_POINTS = "open it in CloudCompare and save it as E57, LAS or PLY"
_SPLATS = "open it in SuperSplat and save it as PLY"
_DRAWN = "export it from its own program as SVG or PNG"
_UNPACK = "unpack it"

_KINDS = {
    ("a Blender file", _BLENDER): "blend blend1 blend2",
    ("Alembic", _BLENDER): "abc",
    ("X3D", _BLENDER): "x3d x3db x3dv x3dz x3dvz",
    ("VRML", _BLENDER): "wrl wrz vrml",
    ("3D Studio", _BLENDER): "3ds ase",
    ("LightWave", _BLENDER): "lwo lws lxo",
    ("DirectX", _BLENDER): "x",
    ("VRM", "rename it to .glb"): "vrm",
    ("a tile of glTF", "take the GLB out of it, for example with 3d-tiles-tools"): "b3dm i3dm cmpt pnts",
    ("a mesh in Draco alone", "decode it to PLY or OBJ with draco_decoder"): "drc",
    ("OpenCTM", "open it in MeshLab and save it as PLY"): "ctm",
    ("KMZ", "unpack it as ZIP: it holds COLLADA, which is read"): "kmz",
    ("AMF", "save it as 3MF or STL"): "amf",
    ("compressed STEP", "unpack it"): "stpz stpx",
    ("STEP", "rename it to .stp"): "p21",
    ("a CAD model", _CAD): "brep brp fcstd sldprt sldasm ipt iam prt catpart catproduct sat sab x_t x_b jt f3d 3dxml",
    ("OpenSCAD", "render it and export it as STL"): "scad",
    ("IFC", "open it in Blender with Bonsai and export it as GLB"): "ifc ifczip ifcxml",
    ("a Rhino model", _OWN): "3dm",
    ("SketchUp", _OWN): "skp skb layout",
    ("3ds Max", _OWN): "max",
    ("Cinema 4D", _OWN): "c4d",
    ("Maya", _OWN): "ma mb",
    (
        "a scene",
        _OWN,
    ): "hip hipnc zpr ztl spp rvt rfa bgeo geo mud sib wings ac cob scn reality xsi babylon uasset unitypackage",
    ("3D in a PDF", _OWN): "u3d prc",
    ("paths of a printer", "use the model that they were made from"): "gcode ctb photon",
    ("a model of a game", _OWN): "md2 md3 md5mesh mdl nif pmx pmd vox smd b3d ms3d mesh psk ogex irr",
    ("VTK", "open it in ParaView and save its surface as PLY"): "vtk vtp vtu vti",
    ("a mesh of simulation", "save its surface as PLY or STL"): "msh inp bdf nas unv cgns med mphtxt",
    ("a point cloud", _POINTS): "ptx pwn fls fws zfs rcp rcs pod",
    ("packed Gaussian splats", _SPLATS): "spz ksplat sog",
    ("HEIC", "save it as JPEG or PNG"): "heic heif",
    ("a drawing", _DRAWN): "dwg eps ai pdf cdr psd xcf kra drawio vsdx emf wmf",
    ("an archive", _UNPACK): "rar 7z gz bz2 xz zst z lz4 zip tar tgz tbz2 txz cab iso",
    ("a pointer of DVC", "fetch the file with `dvc pull`"): "dvc",
}
_BY_EXTENSION = {f".{end}": kind for kind, ends in _KINDS.items() for end in ends.split()}


def refusal(path: Path) -> str | None:
    """Why a file of this name is not read, and what to do; None for a name that is no known kind of shapes."""
    kind = _BY_EXTENSION.get(path.suffix.lower())
    return f"{kind[0]}, which is not read: {kind[1]}" if kind else None

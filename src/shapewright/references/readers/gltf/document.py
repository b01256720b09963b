"""The JSON of a glTF file: the parts of it that say where triangles are, typed and checked."""

from __future__ import annotations

from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta, Raw, Struct

from shapewright.references.errors import UnreadableError

_T = TypeVar("_T")
_Count = Annotated[int, Meta(ge=0, le=2**40)]
_Vector3 = tuple[float, float, float]
_Vector4 = tuple[float, float, float, float]
_Matrix = Annotated[list[float], Meta(min_length=16, max_length=16)]
_Extensions = dict[str, Raw]

DRACO = "KHR_draco_mesh_compression"
INSTANCES = "EXT_mesh_gpu_instancing"
MESHOPT = ("KHR_meshopt_compression", "EXT_meshopt_compression")
VISIBILITY = "KHR_node_visibility"
_APPLIED = {DRACO, INSTANCES, *MESHOPT, VISIBILITY, "KHR_mesh_quantization"}
# Extensions of the registry of Khronos that change no place of a triangle: materials, textures, lights, motion,
# data, and triangles told a second time.
_WITHOUT_EFFECT = {
    "AGI_articulations", "AGI_stk_metadata", "CESIUM_primitive_outline", "EXT_instance_features", "EXT_mesh_features",
    "EXT_mesh_manifold", "EXT_mesh_primitive_edge_visibility", "EXT_mesh_primitive_restart", "EXT_structural_metadata",
    "FB_geometry_metadata", "GODOT_single_root", "GRIFFEL_bim_data", "KHR_animation_pointer", "KHR_audio_emitter",
    "KHR_interactivity", "KHR_node_hoverability", "KHR_node_selectability", "KHR_technique_webgl",
    "KHR_techniques_webgl", "KHR_xmp", "KHR_xmp_json_ld", "VRM",
}  # fmt: skip
_FAMILIES_WITHOUT_EFFECT = (
    *("ADOBE_materials_", "EXT_lights_", "EXT_materials_", "EXT_texture_", "KHR_lights_", "KHR_materials_"),
    *("KHR_physics_", "KHR_texture_", "MSFT_packing_", "MSFT_texture_", "NV_materials_", "VRMC_"),
)


class Asset(Struct, rename="camel", frozen=True):
    """The version of the format, as "2.0" (files of version 1 have a number), and the least that a reader must know."""

    version: str | float
    min_version: str | float | None = None


class Buffer(Struct, rename="camel", frozen=True):
    """Bytes in a file of their own, in a data URI, or, without a URI, in the binary chunk."""

    byte_length: _Count
    uri: str | None = None


class BufferView(Struct, rename="camel", frozen=True):
    """A stretch of a buffer; ``byte_stride`` is from element to element, None or 0 where they are packed."""

    buffer: _Count
    byte_length: _Count
    byte_offset: _Count = 0
    byte_stride: _Count | None = None
    extensions: _Extensions = {}


class SparseIndices(Struct, rename="camel", frozen=True):
    """Which elements a sparse accessor replaces."""

    buffer_view: _Count
    component_type: int
    byte_offset: _Count = 0


class SparseValues(Struct, rename="camel", frozen=True):
    """What they are replaced by, in the accessor's own types."""

    buffer_view: _Count
    byte_offset: _Count = 0


class Sparse(Struct, rename="camel", frozen=True):
    """Elements of an accessor that differ from its base."""

    count: _Count
    indices: SparseIndices
    values: SparseValues


class Accessor(Struct, rename="camel", frozen=True):
    """An array: how the bytes of a buffer view are read; zeros where there is none."""

    component_type: int
    count: _Count
    type: str
    buffer_view: _Count | None = None
    byte_offset: _Count = 0
    normalized: bool = False
    sparse: Sparse | None = None
    min: Any = None
    max: Any = None


class Primitive(Struct, rename="camel", frozen=True):
    """Triangles, lines or points, by ``mode``; each morph target maps attributes to accessors of differences."""

    attributes: dict[str, _Count]
    indices: _Count | None = None
    mode: int = 4
    material: Any = None
    targets: list[dict[str, _Count]] = []
    extensions: _Extensions = {}


class Mesh(Struct, rename="camel", frozen=True):
    """Primitives, and the weights of their morph targets."""

    primitives: list[Primitive]
    name: Any = None
    weights: list[float] = []


class Skin(Struct, rename="camel", frozen=True):
    """The nodes that move a mesh, and an accessor of the matrices that bring the mesh into the frame of each."""

    joints: list[_Count]
    inverse_bind_matrices: _Count | None = None


class Node(Struct, rename="camel", frozen=True):
    """A place in the scene, and what stands there; ``matrix`` is column by column, ``rotation`` is x, y, z, w."""

    children: list[_Count] = []
    matrix: _Matrix | None = None
    translation: _Vector3 = (0.0, 0.0, 0.0)
    rotation: _Vector4 = (0.0, 0.0, 0.0, 1.0)
    scale: _Vector3 = (1.0, 1.0, 1.0)
    name: Any = None
    mesh: _Count | None = None
    skin: _Count | None = None
    weights: list[float] | None = None
    extensions: _Extensions = {}


class Scene(Struct, rename="camel", frozen=True):
    """Nodes that are shown together, with all below them."""

    nodes: list[_Count] = []


class Document(Struct, rename="camel", frozen=True):
    """What a glTF file holds."""

    asset: Asset
    extensions_used: list[str] = []
    extensions_required: list[str] = []
    buffers: list[Buffer] = []
    buffer_views: list[BufferView] = []
    accessors: list[Accessor] = []
    meshes: list[Mesh] = []
    materials: Any = None
    skins: list[Skin] = []
    nodes: list[Node] = []
    scenes: list[Scene] = []
    scene: _Count | None = None


class _Version(Struct, frozen=True):
    asset: Asset | None = None


def parse(text: bytes) -> tuple[Document, tuple[str, ...]]:
    """The document in a JSON text, and a note on each extension that is passed over without being known.

    Raises UnreadableError for what is no glTF 2, and where the file requires an extension that is not known.
    """
    asset = _decoded(text, _Version).asset
    if asset is None:
        raise UnreadableError("broken: a JSON text without 'asset', so not glTF")
    least = asset.min_version or asset.version
    if not str(asset.version).startswith("2.") or (asset.min_version or "2.0") != "2.0":
        raise UnreadableError(f"glTF of version {least}, which is not read; save it as glTF 2.0")
    document = _decoded(text, Document)
    strange = [name for name in document.extensions_required if not (name in _APPLIED or _is_without_effect(name))]
    if strange:
        raise UnreadableError(f"it needs the extension {', '.join(strange)}, which is not known; save it without")
    used = [name for name in document.extensions_used if not (name in _APPLIED or _is_without_effect(name))]
    return document, tuple(f"extension {name} passed over: it is not known" for name in used)


def extension(extensions: _Extensions, name: str, kind: type[_T]) -> _T | None:
    """What an extension says, None where it is absent. Raises UnreadableError where it cannot be understood."""
    return _decoded(bytes(extensions[name]), kind) if name in extensions else None


def material_name(document: Document, number: object) -> object:
    """What a document calls a material; None where it is none. Names decide nothing, so nothing is refused for them."""
    rows = document.materials
    if not isinstance(rows, list) or not isinstance(number, int) or not 0 <= number < len(rows):
        return None
    return rows[number].get("name") if isinstance(rows[number], dict) else None


def at(rows: list[_T], index: int, what: str) -> _T:
    """One of the document's rows. Raises UnreadableError where it has fewer."""
    if index >= len(rows):
        raise UnreadableError(f"broken: it refers to {what} {index}, but has {len(rows)}")
    return rows[index]


def _decoded(text: bytes, kind: type[_T]) -> _T:
    try:
        # Not strict, so that 3.0 counts as 3, as in JSON.
        return msgspec.json.decode(text, type=kind, strict=False)
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
        raise UnreadableError(f"broken: {error}") from error


def _is_without_effect(name: str) -> bool:
    return name in _WITHOUT_EFFECT or name.startswith(_FAMILIES_WITHOUT_EFFECT)

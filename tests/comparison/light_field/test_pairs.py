from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation
from scipy.stats import spearmanr

from shapewright.comparison import light_field
from shapewright.comparison.light_field import Descriptor
from shapewright.comparison.light_field.dodecahedra import alignments, symmetries
from shapewright.settings import Align
from shapewright.shapes import Mesh, concatenate

SHARED = Path(__file__).resolve().parents[3].parent / "shared"
LFD = SHARED / "data" / "lfd"
needs_shared = pytest.mark.skipif(not LFD.is_dir(), reason="needs ../shared/data/lfd")


def box(*size: float, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Mesh:
    made = trimesh.creation.box(extents=size)
    return Mesh(made.vertices + at, made.faces)


def chair(seat: float = 0.5, back: float = 0.9) -> Mesh:
    legs = [box(0.06, seat, 0.06, at=(x, seat / 2, z)) for x in (-0.22, 0.22) for z in (-0.2, 0.2)]
    return concatenate(
        [*legs, box(0.5, 0.05, 0.5, at=(0, seat, 0)), box(0.5, back - seat, 0.05, at=(0, (seat + back) / 2, -0.22))]
    )


def random_descriptor(seed: int, bits: int = 4) -> Descriptor:
    """As far from another as can be: every level is equally likely."""
    rng = np.random.default_rng(seed)
    coefficients = rng.integers(0, 256, size=(10, 10, 47), dtype=np.uint8)
    if bits == 4:
        coefficients[..., :35] //= 16
    return Descriptor(coefficients, bits)


def raw_by_hand(a: Descriptor, b: Descriptor) -> int:
    """The definition: the least of 6,000 sums of ten weighted L1 costs."""
    weights = np.array([1] * 35 + [2] * 10 + [2, 1])
    ours, theirs = (d.coefficients.astype(int) for d in (a, b))
    costs = (np.abs(ours[:, :, None, None] - theirs[None, None]) * weights).sum(axis=-1)  # field, view, field, view
    return min(int(costs[:, range(10), :, row].sum(axis=0).min()) for row in alignments())


@pytest.fixture(scope="module")
def original() -> dict[str, np.ndarray]:
    with np.load(LFD / "original.npz") as file:
        return {key: file[key] for key in file.files}


def load(name: str) -> Mesh:
    mesh = trimesh.load(LFD / "meshes" / f"{name}.ply", process=False)
    return Mesh(mesh.vertices, mesh.faces)


@needs_shared
@pytest.mark.parametrize("bits", [4, 8])
def test_distances_of_the_originals_descriptors_are_equal(original: dict[str, np.ndarray], bits: int):
    suffix = "" if bits == 4 else "_8bit"
    others = (original[field][..., None] for field in ("circularity", "eccentricity"))
    coefficients = np.concatenate([original["art" + suffix], original["fourier"], *others], axis=-1)
    described = [Descriptor(of_one, bits) for of_one in coefficients]
    assert np.array_equal(light_field.raw_distances(described), original["distances" + suffix])


@needs_shared
def test_agreement_with_the_original(original: dict[str, np.ndarray]):
    described = light_field.descriptors(load(name) for name in original["names"])
    found = light_field.raw_distances(described)
    assert np.array_equal(found, found.T)
    assert not found.diagonal().any()
    pairs = np.triu_indices(len(found), 1)
    known, found = original["distances"][pairs], found[pairs]
    error = np.abs(found - known) / known
    assert spearmanr(known, found).statistic >= 0.99999
    assert np.median(error) == 0.0
    assert error.max() <= 0.002
    assert np.array_equal(found <= 2700, known <= 2700)
    fields = np.split(np.stack([d.coefficients for d in described]), [35, 45, 46], axis=-1)
    sizes = {"art": 350_000, "fourier": 100_000, "circularity": 10_000, "eccentricity": 10_000}
    for (field, size), ours in zip(sizes.items(), fields, strict=True):
        equal = ours.squeeze() == original[field]
        assert equal.size == size
        assert equal.mean() > 0.9995


@pytest.mark.parametrize("bits", [4, 8])
def test_distance_is_the_least_of_the_sums(bits: int):
    a, b = random_descriptor(0, bits), random_descriptor(1, bits)
    assert light_field.raw_distance(a, b) == raw_by_hand(a, b)
    assert light_field.raw_distance(a, a) == 0
    assert light_field.raw_distance(a, b, "upright") >= light_field.raw_distance(a, b)


@pytest.mark.parametrize("bits", [4, 8])
def test_the_largest_distance_fits(bits: int):
    nothing = Descriptor(np.zeros((10, 10, 47), np.uint8), bits)
    everything = np.full((10, 10, 47), 255, np.uint8)
    everything[..., :35] = 2**bits - 1
    expected = 10 * (35 * (2**bits - 1) + 2 * 10 * 255 + 2 * 255 + 255)
    for align in ("free", "upright"):
        assert light_field.raw_distance(nothing, Descriptor(everything, bits), align) == expected


@pytest.mark.parametrize("align", ["free", "upright"])
def test_matrices(align: Align):
    shapes = [chair(), chair(seat=0.4), box(1, 1, 1), box(1, 0.1, 0.5)]
    described = light_field.descriptors(shapes)
    raw = light_field.raw_distances(described, align=align)
    assert raw.dtype == np.int32
    assert np.array_equal(raw, raw.T)
    assert not raw.diagonal().any()
    assert (raw + np.eye(4) > 0).all()
    assert np.array_equal(light_field.raw_distances(shapes[:2], described, align), raw[:2])
    assert np.array_equal(light_field.raw_distances(described, shapes[1:3], align, threads=1), raw[:, 1:3])
    assert np.array_equal(light_field.raw_distances(described, align=align, threads=3), raw)
    normalised = light_field.distances(described, align=align)
    assert np.array_equal(normalised, raw / 15000)
    assert light_field.distance(shapes[0], described[1], align) == normalised[0, 1]
    assert light_field.distance(described[1], shapes[0], align) == normalised[0, 1]


def test_matrices_of_nothing():
    assert light_field.distances([]).shape == (0, 0)
    assert light_field.distances([], [box(1, 2, 3)]).shape == (0, 1)


def test_descriptors_do_not_depend_on_threads():
    shapes = [chair(seat) for seat in np.linspace(0.3, 0.6, 5)]
    one, many = light_field.descriptors(shapes, threads=1), light_field.descriptors(shapes, threads=4)
    for a, b in zip(one, many, strict=True):
        assert np.array_equal(a.coefficients, b.coefficients)
        assert a.coefficients.dtype == np.uint8


def test_scale_and_translation_do_not_matter():
    mesh = chair()
    for scale, shift in ((2.0, (0, 0, 0)), (1e-3, (5, 6, -7)), (1e6, (1e5, 0, 0)), (1 / 3, (0.1, 0.2, 0.3))):
        moved = Mesh(mesh.vertices * scale + shift, mesh.faces)
        assert light_field.distance(mesh, moved) < 0.001  # rounding may move a corner by 1/256 of a pixel
    doubled = Mesh(mesh.vertices * 2.0, mesh.faces)
    assert light_field.raw_distance(mesh, doubled) == 0


def test_unused_vertices_do_not_matter():
    mesh = chair()
    more = Mesh(np.vstack([mesh.vertices, [[1e9, -50.0, 3.0]]]), mesh.faces)
    assert light_field.raw_distance(mesh, more) == 0


def test_rotated_cameras_see_the_same():
    described = light_field.descriptor(chair())
    for row in alignments()[::7]:
        turned = Descriptor(described.coefficients[:, row])
        assert light_field.raw_distance(described, turned) == 0
    fields = Descriptor(described.coefficients[::-1])
    assert light_field.raw_distance(described, fields) == 0


def test_a_rotated_shape_stays_compatible_with_itself():
    """Not equal: pixels along a slanted edge, and the box around them, differ from those along an upright one."""
    mesh = chair()
    described = light_field.descriptor(mesh)
    turned = light_field.descriptors(mesh.transformed(rotation) for rotation in symmetries()[::5])
    assert light_field.distances([described], turned).max() < light_field.THRESHOLD


def test_upright_finds_turns_about_y_only():
    mesh = chair()
    turned = mesh.transformed(Rotation.from_euler("y", 90, degrees=True).as_matrix())
    toppled = mesh.transformed(Rotation.from_euler("x", 90, degrees=True).as_matrix())
    assert light_field.distance(mesh, turned, "upright") < light_field.THRESHOLD
    assert light_field.distance(mesh, toppled, "upright") > light_field.THRESHOLD
    assert light_field.distance(mesh, toppled, "free") < light_field.THRESHOLD


def test_likeness_orders_distances():
    mesh = chair()
    near, far = chair(seat=0.47), box(1, 1, 1)
    assert 0 < light_field.distance(mesh, near) < light_field.THRESHOLD < light_field.distance(mesh, far)


def test_cache_is_used(tmp_path: Path):
    first = light_field.descriptors([chair(), box(1, 2, 3)], cache=tmp_path)
    assert len(list(tmp_path.iterdir())) == 2
    again = light_field.descriptor(chair(), cache=str(tmp_path))
    assert np.array_equal(first[0].coefficients, again.coefficients)


# Degenerate shapes


def test_ten_triangles():
    rim = np.array([[np.cos(a), 0.0, np.sin(a)] for a in 2 * np.pi * np.arange(5) / 5])
    faces = [[n, (n + 1) % 5, tip] for n in range(5) for tip in (5, 6)]
    described = light_field.descriptor(Mesh(np.vstack([rim, [[0, 1, 0], [0, -1, 0]]]), np.array(faces)))
    assert (described.coefficients.max(axis=-1) > 0).all()


def test_a_million_triangles():
    side = np.linspace(-1, 1, 708)
    x, z = np.meshgrid(side, side)
    corner = (np.arange(707)[:, None] * 708 + np.arange(707)).ravel()
    faces = np.concatenate([corner[:, None] + [0, 1, 708], corner[:, None] + [1, 709, 708]])
    hills = Mesh(np.column_stack([x.ravel(), 0.2 * np.sin(4 * x * z).ravel(), z.ravel()]), faces[:1_000_000])
    assert (light_field.descriptor(hills).coefficients.max(axis=-1) > 0).all()


def test_a_flat_sheet_is_empty_edge_on():
    sheet = Mesh(np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1.0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    described = light_field.descriptor(sheet)
    seen = described.coefficients.max(axis=-1) > 0
    assert not seen[0, [2, 6]].any()  # the first dodecahedron's cameras at no height
    assert seen.sum() >= 95
    assert light_field.raw_distance(sheet, sheet) == 0


def test_duplicate_and_reversed_faces_do_not_matter():
    mesh = chair()
    doubled = Mesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[::2, ::-1]]))
    assert light_field.raw_distance(mesh, doubled) == 0


@pytest.mark.filterwarnings("ignore:overflow encountered")
@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        (np.zeros((0, 3)), np.zeros((0, 3), int), "without faces"),
        (np.eye(3), np.zeros((0, 3), int), "without faces"),
        (np.ones((3, 3)), [[0, 1, 2]], "no size"),
        (np.eye(3), [[1, 1, 1]], "no size"),
        ([[0, 0, 0], [1, 2, 3], [2, 4, 6]], [[0, 1, 2]], "no area"),
        ([[0, 0, 0], [1, 0, 0], [1, 0, 0]], [[0, 1, 2], [1, 1, 0]], "no area"),
        ([[-1.7e308, 0, 0], [1.7e308, 0, 0], [0, 1, 0]], [[0, 1, 2]], "cannot be normalised"),
        (np.eye(3) * 1e-310, [[0, 1, 2]], "cannot be normalised"),
    ],
)
def test_shapes_that_cannot_be_seen(vertices: np.ndarray, faces: np.ndarray, message: str):
    mesh = Mesh(np.array(vertices), np.array(faces))
    with pytest.raises(ValueError, match=message):
        light_field.descriptor(mesh)
    with pytest.raises(ValueError, match=f"shape 1: .*{message}"):
        light_field.descriptors([chair(), mesh], threads=2)


def test_errors():
    with pytest.raises(ValueError, match="cannot be compared"):
        light_field.distance(random_descriptor(0), random_descriptor(0, bits=8))
    with pytest.raises(ValueError, match="align"):
        light_field.distance(chair(), chair(), align="sideways")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="4 or 8"):
        light_field.descriptor(chair(), bits=5)

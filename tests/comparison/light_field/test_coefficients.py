from pathlib import Path

import numpy as np
import pytest

from shapewright.comparison.light_field.coefficients import COEFFICIENTS, coefficients, quantise

SHARED = Path(__file__).resolve().parents[3].parent / "shared"
SIZE = 256
FIELDS = {"art": slice(0, 35), "fourier": slice(35, 45), "circularity": 45, "eccentricity": 46}


def blank(count: int = 1) -> np.ndarray:
    return np.zeros((count, SIZE, SIZE), dtype=np.uint8)


def disc(radius: float, row: float = 128.0, column: float = 128.0) -> np.ndarray:
    rows, columns = np.mgrid[:SIZE, :SIZE]
    return (np.hypot(rows - row, columns - column) <= radius).astype(np.uint8)


def lopsided() -> np.ndarray:
    """A silhouette without any symmetry, with a hole."""
    image = disc(40, 100, 120) | disc(25, 150, 150)
    image[60:140, 60:75] = 1
    image[90:110, 110:130] = 0
    return image


@pytest.mark.skipif(not (SHARED / "data" / "lfd").is_dir(), reason="needs ../shared/data/lfd")
def test_coefficients_equal_the_originals_bit_for_bit():
    original = np.load(SHARED / "data" / "lfd" / "original.npz")
    given = np.load(SHARED / "data" / "lfd" / "silhouettes.npz")
    names = list(original["names"])
    for name, packed in zip(given["names"], given["packed"], strict=True):
        values = np.stack([coefficients(images) for images in np.unpackbits(packed, axis=-1)])
        levels, shape = quantise(values), names.index(name)
        for field, where in FIELDS.items():
            assert np.array_equal(levels[..., where], original[field][shape]), (name, field)
        assert np.array_equal(quantise(values, bits=8)[..., FIELDS["art"]], original["art_8bit"][shape])


def test_angular_radial_transform_is_the_sum_over_pixels():
    """The definition, pixel by pixel, in place of symmetric sums over shared-out weights."""
    image = blank()[0]
    image[64:192, 64:192] = lopsided()[::2, ::2]
    rows, columns = np.nonzero(image)
    dy = rows - (rows.min() + rows.max()) / 2
    dx = columns - (columns.min() + columns.max()) / 2
    scale = 50 / np.hypot(dy, dx).max()
    y, x = np.mgrid[-50:52, -50:52]
    radius, angle = np.hypot(y, x), np.arctan2(y, x)
    expected = []
    for p in range(12):
        for q in range(3):
            table = np.where(radius < 50, np.cos(np.pi * q * radius / 50) * np.exp(1j * p * angle), 0)
            total = 0.0
            for down, across in zip(dy * scale + 50, dx * scale + 50, strict=True):
                r, c = int(down), int(across)
                lower, upper = (table[k, c] + (table[k, c + 1] - table[k, c]) * (across - c) for k in (r, r + 1))
                total += lower + (upper - lower) * (down - r)
            expected.append(abs(total) / len(rows))
    found = coefficients(image[None])[0, FIELDS["art"]]
    assert np.allclose(found, expected[1:], rtol=0, atol=1e-12)


def test_a_disc_is_round():
    values = coefficients(disc(60)[None])[0]
    assert values[FIELDS["eccentricity"]] == 0.0
    assert values[FIELDS["fourier"]].max() < 0.01
    assert np.allclose(values[FIELDS["art"]][2:].reshape(11, 3)[:, 0], 0.0, atol=0.02)
    assert values[FIELDS["circularity"]] == pytest.approx((np.pi / 4) ** 2, abs=0.02)  # steps along the rim: 8 radii


def test_a_rectangle_by_hand():
    image = blank()
    image[0, 100:140, 50:150] = 1
    values = coefficients(image)[0]
    down, across = (40**2 - 1) / 12, (100**2 - 1) / 12
    assert values[FIELDS["eccentricity"]] == pytest.approx(((down - across) / (down + across)) ** 2)
    assert values[FIELDS["circularity"]] == pytest.approx(4 * np.pi * 4000 / (2 * 100 + 2 * 38) ** 2)


def test_a_contour_by_hand():
    """A square of 5 x 5 pixels: sixteen pixels along its rim, and the start once more."""
    image = blank()
    image[0, 100:105, 100:105] = 1
    rim = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 1), (4, 2), (4, 3), (4, 4)]
    rim += [(3, 4), (2, 4), (1, 4), (0, 4), (0, 3), (0, 2), (0, 1), (0, 0)]
    spectrum = np.abs(np.fft.fft([np.hypot(row - 2, column - 2) for row, column in rim]))
    assert np.allclose(coefficients(image)[0, FIELDS["fourier"]][:8], spectrum[1:9] / spectrum[0])


@pytest.mark.parametrize("gap", [1, 2, 3, 5, 40])
def test_the_contour_of_two_parts_goes_around_both(gap: int):
    """Up to the widest gap the parts are joined in another way: by one dilation, by two, by the bounding box."""
    apart, together = blank(), blank()
    apart[0, 100:140, 60:100] = 1
    apart[0, 100:140, 100 + gap : 140 + gap] = 1
    together[0, 100:140, 60 : 140 + gap] = 1
    first = coefficients(apart)[0, FIELDS["fourier"]]
    around = coefficients(together)[0, FIELDS["fourier"]]
    one_part = blank()
    one_part[0, 100:140, 60:100] = 1
    alone = coefficients(one_part)[0, FIELDS["fourier"]]
    assert np.abs(first - around).max() < np.abs(alone - around).max()


def test_a_crumb_is_left_out_of_the_contour():
    """Parts of no more than a twentieth of the foreground do not count."""
    image, crumb = blank(), blank()
    image[0, 80:180, 80:180] = 1
    crumb[0] = image[0]
    crumb[0, 100:105, 182:190] = 1
    image[0, 130, 189] = 1  # keeps the middle of the bounding box where the crumb puts it
    found, expected = (coefficients(each)[0, FIELDS["fourier"]] for each in (crumb, image))
    assert np.allclose(found, expected)


def test_empty_and_single_pixels():
    images = blank(3)
    images[1, 100, 100] = 1
    images[2] = lopsided()
    values = coefficients(images)
    assert not values[0].any()
    assert np.isfinite(values).all()
    assert values[1, FIELDS["eccentricity"]] == 0.0
    assert values[1, FIELDS["circularity"]] == 1.0
    assert not values[1, FIELDS["fourier"]].any()
    assert not coefficients(blank(2)).any()


def test_noise_ends():
    rng = np.random.default_rng(0)
    images = blank(10)
    for image, density in zip(images, np.linspace(0.01, 0.9, 10), strict=True):
        image[20:236, 20:236] = rng.random((216, 216)) < density
    values = coefficients(images)
    assert np.isfinite(values).all()
    assert values.shape == (10, COEFFICIENTS)


def test_position_does_not_matter():
    image = lopsided()
    moved = np.roll(image, (31, -17), axis=(0, 1))
    assert np.array_equal(coefficients(image[None]), coefficients(moved[None]))


def test_views_of_a_light_field_share_their_scale():
    together = coefficients(np.stack([disc(30), disc(60)]))
    apart = np.concatenate([coefficients(disc(30)[None]), coefficients(disc(60)[None])])
    assert np.array_equal(together[1], apart[1])
    assert np.abs(together[0] - apart[0])[FIELDS["art"]].max() > 0.1
    assert np.array_equal(together[0, 35:], apart[0, 35:])


def test_quantisation():
    values = np.zeros((5, COEFFICIENTS))
    values[0, :35] = 0.003585473  # a level itself belongs to the one below
    values[1, :35] = 0.0035854731
    values[2, :] = 1.0
    values[3, 35:45], values[4, 35:45] = 0.5 - 1 / 1024, 1 / 512
    levels = quantise(values)
    assert (levels[0, :35] == 0).all()
    assert (levels[1, :35] == 1).all()
    assert (levels[2] == [15] * 35 + [255] * 12).all()
    assert (levels[3, 35:45] == 255).all()
    assert (levels[4, 35:45] == 1).all()
    assert (quantise(values, bits=8)[2] == 255).all()
    with pytest.raises(ValueError, match="4 or 8"):
        quantise(values, bits=6)

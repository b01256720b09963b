import io
import re

import numpy as np
import pytest
import shapely
from PIL import Image, features

from benches import AREA, bench, overlap
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.pictures import MOST, read_picture


def saved(picture, mode=None, kind="PNG", **options) -> bytes:
    buffer = io.BytesIO()
    image = picture if isinstance(picture, Image.Image) else Image.fromarray(np.asarray(picture), mode)
    image.save(buffer, kind, **options)
    return buffer.getvalue()


def likeness(data: bytes) -> float:
    """The IoU with the bench, both of the same size."""
    drawing, _ = read_picture(data)
    x, y, far, top = drawing.geometry.bounds
    shape = shapely.affinity.scale(drawing.geometry, 48 / (far - x), 26 / (top - y), origin=(x, y))
    return overlap(shapely.affinity.translate(shape, 8 - x, -46 - y), AREA)


def coloured(mode: str) -> Image.Image:
    return Image.fromarray(bench()).convert("RGB").convert(mode)


RGBA = np.stack([np.zeros((64, 64), np.uint8)] * 3 + [255 - bench()], axis=-1)
FLOATS = Image.fromarray((bench() / 255.0).astype(np.float32))


@pytest.mark.parametrize(
    "data",
    [
        saved(bench()),
        saved(bench(white=200, black=90)),
        saved(bench(white=110, black=10)),
        saved(bench(white=65535, dtype=np.uint16)),
        saved(bench(white=4095, dtype=np.uint16)),
        saved(bench(white=4095, dtype=np.int32), kind="TIFF"),
        saved(np.stack([bench()] * 3, axis=-1)),
        saved(np.stack([np.zeros((64, 64), np.uint8), 255 - bench()], axis=-1), "LA"),
        saved(RGBA),
        saved(RGBA + np.array([250, 250, 250, 0], np.uint8)),
        saved(bench() > 0),
        saved(coloured("P")),
        saved(coloured("P"), transparency=coloured("P").getpixel((0, 0))),
        saved(bench(), kind="JPEG", quality=85),
        saved(coloured("CMYK"), kind="JPEG", quality=95),
        saved(coloured("CMYK"), kind="TIFF"),
        saved(FLOATS, kind="TIFF"),
        saved(bench(), kind="WEBP", lossless=True),
        saved(bench(), kind="GIF"),
        saved(bench(), kind="BMP"),
    ],
    ids=[
        "grey", "pale", "dim", "16 bits", "12 bits in 16", "12 bits in 32", "colour", "transparent", "RGBA",
        "white on nothing", "1 bit", "palette", "transparent palette", "JPEG", "CMYK JPEG", "CMYK TIFF", "floats",
        "WebP", "GIF", "BMP",
    ],
)  # fmt: skip
def test_the_dark_part_is_outlined_whatever_the_format_and_mode(data):
    assert read_picture(data)[1] == () and likeness(data) > 0.98


@pytest.mark.skipif(not features.check("avif"), reason="this Pillow has no AVIF")
def test_avif():
    assert likeness(saved(bench(), kind="AVIF", quality=95)) > 0.98


@pytest.mark.parametrize("orientation", [3, 6, 8])
def test_the_rotation_that_a_camera_writes_down_is_followed(orientation):
    turned = np.rot90(bench(), {3: 2, 6: 1, 8: 3}[orientation])
    exif = Image.Exif()
    exif[0x0112] = orientation
    assert likeness(saved(turned.copy(), kind="JPEG", quality=90, exif=exif)) > 0.98


def test_holes_islands_and_corners_that_touch():
    picture = np.full((30, 30), 255, dtype=np.uint8)
    picture[5:25, 5:25] = 0
    picture[10:20, 10:20] = 255
    picture[13:17, 13:17] = 0
    picture[1:5, 1:5] = 0  # meets the frame at a corner
    drawing, _ = read_picture(saved(picture))
    assert drawing.geometry.is_valid
    assert drawing.geometry.area == pytest.approx(400 - 100 + 16 + 16, abs=1.5)
    assert len(shapely.get_parts(drawing.geometry)) == 3


def test_outlines_lie_between_grey_pixels():
    y, x = np.mgrid[:64, :64]
    disc = np.clip(np.hypot(x - 31.3, y - 30.8) - 20.0 + 0.5, 0, 1)
    drawing, _ = read_picture(saved((disc * 255).astype(np.uint8)))
    assert overlap(drawing.geometry, shapely.Point(31.3, -30.8).buffer(20.0, quad_segs=64)) > 0.985


def test_a_slanted_line_as_wide_as_a_pixel_stays_whole():
    y, x = np.mgrid[:64, :64]
    away = np.abs((x - 5) * np.sin(0.6) - (y - 5) * np.cos(0.6))
    drawing, _ = read_picture(saved((np.clip(away, 0, 1) * 255).astype(np.uint8)))
    assert len(shapely.get_parts(drawing.geometry)) == 1


def test_large_pictures_are_reduced_with_a_note():
    data = saved(np.kron(bench(), np.ones((40, 40), dtype=np.uint8)))
    drawing, notes = read_picture(data)
    assert np.ptp(drawing.bounds, axis=0).max() == pytest.approx(2560 / 2 * 48 / 64, abs=1)
    assert notes == ("reduced to 1/2 of its 2560 x 2560 pixels",) and likeness(data) > 0.98


@pytest.mark.parametrize(("light", "note"), [(False, "reduced"), (True, "its light part is the drawing")])
def test_lines_of_one_pixel_stay_in_a_large_picture(light, note):
    frame = np.full((3 * MOST, 3 * MOST), 255, dtype=np.uint8)
    frame[500:5000, [500, 5000]] = 0
    frame[[500, 5000], 500:5001] = 0
    drawing, notes = read_picture(saved(255 - frame if light else frame))
    assert np.ptp(drawing.bounds, axis=0) == pytest.approx([1501, 1501], abs=1) and note in notes[0]
    assert drawing.geometry.area < 1501 * 5


def test_what_touches_the_rim_is_closed():
    drawing, notes = read_picture(saved(np.zeros((4, 8), dtype=np.uint8)))
    assert drawing.geometry.area == pytest.approx(32, abs=1) and notes == ()


def test_light_on_dark_is_read_with_a_note():
    data = saved(255 - bench())
    assert read_picture(data)[1] == ("dark all round: its light part is the drawing",) and likeness(data) > 0.98


def test_a_frame_along_the_rim_is_no_page():
    picture = np.zeros((64, 64), dtype=np.uint8)
    picture[4:-4, 4:-4] = 255
    drawing, notes = read_picture(saved(picture))
    assert drawing.geometry.area == pytest.approx(64 * 64 - 56 * 56, rel=0.02) and "its dark part" in notes[0]


@pytest.mark.parametrize(
    "picture", [bench(black=230), bench(black=255), bench(white=60000, black=52000, dtype=np.uint16)]
)
def test_nothing_dark(picture):
    with pytest.raises(UnreadableError, match="nothing in the picture is dark"):
        read_picture(saved(picture))


class TestFineSpots:
    NOISE = np.random.default_rng(0).random((256, 256))

    def test_specks_of_a_scan_are_cleared_with_a_note(self):
        large = np.kron(bench(), np.ones((16, 16), dtype=np.uint8))
        large[np.random.default_rng(0).random(large.shape) < 0.01] ^= 255
        assert "dithered or noisy: seen at 512 x 512 pixels" in read_picture(saved(large))[1]
        assert likeness(saved(large)) > 0.9

    def test_a_dithered_grey_bench_is_the_bench(self):
        grey = np.kron(np.where(bench() > 0, 250, 60), np.ones((8, 8))).astype(np.uint8)
        assert likeness(saved(Image.fromarray(grey).convert("1"))) > 0.85

    def test_noise_is_no_drawing(self, monkeypatch):
        monkeypatch.setattr("shapewright.references.readers.pictures._OUTLINES", 2)
        with pytest.raises(UnreadableError, match="no line drawing"):
            read_picture(saved(self.NOISE > 0.5))


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"<!DOCTYPE html><title>404</title>", "holds a web page, not a picture that is read"),
        (b"not found\n", "holds text, not a picture"),
        (b"PK\3\4" + bytes(30), "holds a ZIP archive, not a picture"),
        (b"%PDF-1.4\n", "holds a PDF, not a picture"),
        (bytes(100), "holds unknown data, not a picture"),
        (saved(bench())[:60], "broken: the picture cannot be decoded"),
        (saved(bench(), kind="JPEG")[:300], "broken: the picture cannot be decoded"),
    ],
)
def test_a_file_without_a_picture_says_what_it_holds(data, why):
    with pytest.raises(UnreadableError, match=re.escape(why)) as error:
        read_picture(data)
    assert "BytesIO" not in str(error.value)


def test_a_picture_of_too_many_pixels_is_refused_before_it_is_decoded():
    data = saved(Image.new("1", (30_000, 30_000)))
    with pytest.raises(UnreadableError, match="too large: more than 89 million pixels"):
        read_picture(data)


def test_of_several_pictures_the_first_is_read_with_a_note():
    frames = [Image.fromarray(bench()), Image.fromarray(255 - bench())]
    data = saved(frames[0], kind="GIF", save_all=True, append_images=frames[1:])
    assert read_picture(data)[1] == ("the first of its 2 pictures",) and likeness(data) > 0.98

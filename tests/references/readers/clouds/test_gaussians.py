import struct

import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.gaussians import read_splat
from shapewright.references.readers.ply import read_ply

PLACES = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
TOLD = ("Gaussian splats: their centres are taken as points", "1 of 3 splats left out: they are nearly transparent")


def test_splats_of_32_bytes_without_those_that_are_nearly_transparent():
    rows = [
        struct.pack("<6f8B", *place, 0.1, 0.1, 0.1, 9, 9, 9, alpha, 128, 128, 128, 255)
        for place, alpha in zip(PLACES, (255, 12, 26), strict=True)
    ]
    cloud = read_splat(b"".join(rows))
    assert (cloud.positions == PLACES[[0, 2]]).all()
    assert cloud.notes == TOLD
    with pytest.raises(UnreadableError, match="cut short: 95 bytes"):
        read_splat(b"".join(rows)[:-1])


@pytest.mark.parametrize("opacity", ["opacity", "scale_0"], ids=["splats", "no splats"])
def test_splats_of_training_keep_their_opacity_as_a_logit(opacity):
    names = [*"xyz", "nx", "ny", "nz", "f_dc_0", "opacity", "scale_0", "rot_0"]
    if opacity != "opacity":
        names.remove("opacity")
    values = {name: np.zeros(3) for name in names} | dict(zip("xyz", PLACES.T, strict=True))
    values |= {"opacity": np.array([4.0, -2.5, -2.0])} if opacity == "opacity" else {}
    head = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
    head += "".join(f"property float {name}\n" for name in names) + "end_header\n"
    cloud = read_ply(head.encode() + np.column_stack([values[name] for name in names]).astype("<f4").tobytes())
    if opacity == "opacity":
        assert (cloud.positions == PLACES[[0, 2]]).all()
        assert cloud.notes == TOLD
    else:
        assert (cloud.positions == PLACES).all()
        assert cloud.notes == ()

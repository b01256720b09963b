"""A bench as a picture of 64 x 64 pixels, and its area: a top of 48 x 6 and two legs of 4 x 20."""

import numpy as np
import shapely

AREA = shapely.union_all([shapely.box(8, -26, 56, -20), shapely.box(10, -46, 14, -20), shapely.box(50, -46, 54, -20)])


def bench(white=255, black=0, dtype=np.uint8):
    picture = np.full((64, 64), white, dtype=dtype)
    picture[20:26, 8:56] = black
    picture[26:46, 10:14] = black
    picture[26:46, 50:54] = black
    return picture


def overlap(one, other):
    return one.intersection(other).area / one.union(other).area

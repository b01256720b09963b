import numpy as np

from shapewright.modelling.solids import box
from shapewright.prediction.lookup import nearest
from shapewright.rendering.raster import render


def test_the_nearest_sample_is_the_most_similar_shape():
    sizes = [(1, 0.2, 1), (1, 1, 1), (0.2, 1, 0.2), (1, 0.5, 0.1)]
    samples = render([box(size).mesh().normalised() for size in sizes], size=32)
    jittered = [(width * 1.07, height * 1.07, depth) for width, height, depth in sizes]
    references = render([box(size).mesh().normalised() for size in reversed(jittered)], size=32)
    assert nearest(references, samples).tolist() == [3, 2, 1, 0]
    assert nearest(references[:0], samples).shape == (0,)
    assert nearest(samples, samples).dtype == np.int64

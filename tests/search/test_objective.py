import numpy as np

from shapewright.modelling.solids import box
from shapewright.search.objective import measure_of


class Width:
    """How much wider or narrower than 1 a mesh is."""

    def residual(self, replica):
        return np.array([replica.extent[0] - 1.0])


def test_each_replica_is_measured_by_its_own_objective():
    wide = box((3, 1, 1)).mesh()
    for threads in (1, 4):
        first, second, third = measure_of([None, Width()], threads)([(1, wide), (0, wide), (1, box(1).mesh())])
        assert first.tolist() == [2.0] and second is None and third.tolist() == [0.0]

import math

from shapewright.judging.target import Measures, means


def test_means_are_of_what_can_be_measured_of_all_and_of_replicated_ones():
    pairs = [Measures(0.1, 0.9, f1=1.0), Measures(0.3, 0.5), Measures()]
    found = means(pairs, ["replicated", "close", "different"])
    assert (found["all"].distance, found["all"].iou, found["all"].f1) == (0.2, 0.7, 1.0)
    assert (found["replicated"].distance, found["replicated"].iou) == (0.1, 0.9)
    assert math.isnan(found["all"].volume_iou)


def test_of_nothing_there_is_no_mean():
    assert all(math.isnan(value) for of in means([], []).values() for value in of.by_name().values())

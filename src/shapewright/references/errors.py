"""What can go wrong with a collection, and with one file of it."""


class CollectionError(ValueError):
    """There is no collection to be had from this source; the message says what to do."""


class UnreadableError(ValueError):
    """One file holds no usable triangles and no drawing; the message is the reason in ``Collection.skipped``."""

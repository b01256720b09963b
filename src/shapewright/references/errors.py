"""What can go wrong with a collection, and with one file of it."""


class CollectionError(ValueError):
    """A source gives no collection; the message says what to do."""


class UnreadableError(ValueError):
    """One file holds no usable triangles and no drawing; the message is the reason in ``Collection.skipped``."""

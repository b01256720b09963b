"""A reader that goes wrong as decoders do, by the name of the file; found by the processes that read, too."""

import os
import signal
import time

import numpy as np

from shapewright.references.reading import attempt as read
from shapewright.references.reference import Reference


def attempt(source):
    match source.name:
        case "hangs":
            time.sleep(60)
        case "dies":
            os.kill(os.getpid(), signal.SIGSEGV)
        case "eats":
            np.ones(2**30)
    found = read(source)
    if source.name == "where" and isinstance(found, Reference):
        return Reference(found.name, found.path, found.shape, found.transform, notes=(str(os.getpid()),))
    return found

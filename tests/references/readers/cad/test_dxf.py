import sys

import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read


def test_without_the_library_of_drawings_the_way_to_it_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    (tmp_path / "a.dxf").write_text("0\nSECTION\n0\nENDSEC\n0\nEOF\n")
    with pytest.raises(UnreadableError, match=r"pip install 'shapewright\[cad\]'"):
        read(tmp_path / "a.dxf")

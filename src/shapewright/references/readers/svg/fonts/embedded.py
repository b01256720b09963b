"""The fonts that a file brings along: ``@font-face`` rules with their data."""

from __future__ import annotations

import base64
import binascii
import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any
from urllib.parse import unquote_to_bytes

import tinycss2

from shapewright.references.readers.svg.fonts.faces import Face, faces_in

_DATA = re.compile(r"url\(\s*[\"']?data:([^,\"')]*),([^\"')]*)", re.IGNORECASE)
_WEIGHTS = {"normal": 400, "bold": 700}


def faces_of(rule: Any) -> Iterator[Face]:
    """The font of a rule, as tinycss2 parses it, under the name that it gives it; none where its data lie elsewhere."""
    told = {
        one.lower_name: tinycss2.serialize(one.value).strip()
        for one in tinycss2.parse_blocks_contents(rule.content or [], True, True)
        if one.type == "declaration"
    }
    family = told.get("font-family", "").strip("\"'").lower()
    for kind, body in _DATA.findall(told.get("src", "")):
        try:
            data = base64.b64decode(unquote_to_bytes(body)) if "base64" in kind else unquote_to_bytes(body)
        except binascii.Error:
            continue
        face = next(faces_in(data), None)
        if face is not None:
            weight = told.get("font-weight", str(face.weight)).split()[0]
            heavy = _WEIGHTS.get(weight) or (int(weight) if weight.isdecimal() else face.weight)
            slanted = told.get("font-style", "italic" if face.slanted else "normal") != "normal"
            yield replace(face, family=family, weight=heavy, slanted=slanted)
            return

"""Reads the fields of a binary PLY of triangles that asdf_vk wrote. Uses NumPy only."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

_TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "uint": "<u4"}
_OTHERS = {"x", "y", "z", "corner_count", "vertex_indices", "red", "green", "blue", "alpha"}


def fields_of_ply(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Returns fields per face and fields per vertex. Keys are names."""
    header, body = re.split(rb"(?<=\nend_header)\n", path.read_bytes(), maxsplit=1)
    text = header.decode()
    assert "format binary_little_endian 1.0" in text
    fields: dict[str, dict[str, Any]] = {}
    for element, count, lines in re.findall(r"element (\w+) (\d+)\n((?:property .*\n)+)", text):
        types: list[Any] = []
        for line in lines.splitlines():
            *kind, name = line.split()[1:]
            triangle = [("corner_count", "u1"), ("vertex_indices", "<i4", 3)]
            types += triangle if kind == ["list", "uchar", "int"] else [(name, _TYPES[kind[0]])]
        rows = np.frombuffer(body, types, int(count))
        body = body[rows.nbytes :]
        quality = re.search(r"quality %sis (\w+)" % ("" if element == "face" else "of vertices "), text)
        columns = {name: rows[name] for name in rows.dtype.names or () if name not in _OTHERS}
        if quality:
            columns[quality[1]] = columns.pop("quality")
        vectors = {name[:-2] for name in columns if name.endswith("_x")}
        for name in vectors:
            columns[name] = np.stack([columns.pop(f"{name}_{axis}") for axis in "xyz"], axis=1)
        fields[element] = columns
    assert not body
    return fields["face"], fields["vertex"]

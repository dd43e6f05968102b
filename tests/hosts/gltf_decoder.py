"""The triangles of a GLB or embedded glTF by NumPy, with the transforms of its nodes: a second reader for the tests."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


def corners_of(path: Path) -> np.ndarray:
    """(triangles, 3, 3), in double."""
    content = path.read_bytes()
    binary = b""
    if content.startswith(b"glTF"):
        (length,) = struct.unpack_from("<I", content, 12)
        document = json.loads(content[20 : 20 + length])
        binary = content[28 + length :]
    else:
        document = json.loads(content)
    buffers = [base64.b64decode(b["uri"].split(",", 1)[1]) if "uri" in b else binary for b in document["buffers"]]

    def array(index: int, width: int) -> np.ndarray:
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        dtype = np.dtype(TYPES[accessor["componentType"]])
        offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", dtype.itemsize * width)
        entries = np.ndarray((accessor["count"], width), dtype, buffers[view["buffer"]], offset, (stride, dtype.itemsize))
        if not accessor.get("normalized"):
            return entries.astype(np.float64 if dtype.kind == "f" or width == 3 else np.int64)
        return np.maximum(entries / np.iinfo(dtype).max, -1)

    def matrix(node: dict[str, Any]) -> np.ndarray:
        if "matrix" in node:
            return np.array(node["matrix"], np.float64).reshape(4, 4).T
        x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), np.float64)
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])  # fmt: skip
        result = np.eye(4)
        result[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)))
        result[:3, 3] = node.get("translation", (0, 0, 0))
        return result

    found = []

    def visit(index: int, outer: np.ndarray) -> None:
        node = document["nodes"][index]
        place = outer @ matrix(node)
        for primitive in document["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            points = array(primitive["attributes"]["POSITION"], 3) @ place[:3, :3].T + place[:3, 3]
            indices = array(primitive["indices"], 1).ravel() if "indices" in primitive else np.arange(len(points))
            triangles = points[indices].reshape(-1, 3, 3)
            found.append(triangles[:, ::-1] if np.linalg.det(place[:3, :3]) < 0 else triangles)
        for child in node.get("children", ()):
            visit(child, place)

    for root in document["scenes"][document.get("scene", 0)]["nodes"]:
        visit(root, np.eye(4))
    return np.concatenate(found)

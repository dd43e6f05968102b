"""The triangles of a 3MF file by zipfile and ElementTree, with components and transforms: a second reader for the tests."""

from __future__ import annotations

import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


def corners_of(path: Path) -> np.ndarray:
    """(triangles, 3, 3), in double, in the unit of the file."""
    with zipfile.ZipFile(path) as archive:
        (name,) = [name for name in archive.namelist() if name.endswith(".model")]
        model = ElementTree.fromstring(archive.read(name))
    objects = {element.get("id"): element for element in model.iter(f"{CORE}object")}
    found = []

    def placed(corners: np.ndarray, transform: str | None) -> np.ndarray:
        if transform is None:
            return corners
        numbers = np.array(transform.split(), np.float64).reshape(4, 3)
        moved = corners @ numbers[:3] + numbers[3]
        return moved[:, ::-1] if np.linalg.det(numbers[:3]) < 0 else moved

    def triangles(number: str) -> np.ndarray:
        element = objects[number]
        points = [[float(v.get(axis)) for axis in "xyz"] for v in element.iter(f"{CORE}vertex")]
        faces = [[int(t.get(corner)) for corner in ("v1", "v2", "v3")] for t in element.iter(f"{CORE}triangle")]
        parts = [np.array(points, np.float64).reshape(-1, 3)[np.array(faces, np.int64).reshape(-1, 3)]]
        for component in element.iter(f"{CORE}component"):
            parts.append(placed(triangles(component.get("objectid")), component.get("transform")))
        return np.concatenate(parts)

    for item in model.iter(f"{CORE}item"):
        found.append(placed(triangles(item.get("objectid")), item.get("transform")))
    return np.concatenate(found)

"""Normals of an object with `vertices` and `faces`, for example of a trimesh.Trimesh."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._arrays import float_points
from .._errors import error_of


def face_normals(mesh: Any) -> NDArray[np.float64]:
    """Returns outward normals, (m, 3), of any length: `mesh.face_normals`, or computed. Degenerate faces may have 0."""
    if hasattr(mesh, "face_normals"):
        return _checked(mesh.face_normals, "face_normals", len(mesh.faces))
    a, b, c = _corners(mesh)
    normals: NDArray[np.float64] = np.cross(b - a, c - a)
    return normals


def vertex_normals(mesh: Any) -> NDArray[np.float64]:
    """Returns (n, 3): `mesh.vertex_normals` if it exists, else angle-weighted means over faces, of length 1."""
    if hasattr(mesh, "vertex_normals"):
        return _checked(mesh.vertex_normals, "vertex_normals", len(mesh.vertices))
    a, b, c = _corners(mesh)
    normals, faces = np.nan_to_num(unit(face_normals(mesh))), np.asarray(mesh.faces)
    sums = np.zeros((len(mesh.vertices), 3))
    for corner, (at, to, other) in enumerate(((a, b, c), (b, c, a), (c, a, b))):
        cosine = (unit(to - at) * unit(other - at)).sum(axis=1)
        angles = np.nan_to_num(np.arccos(np.clip(cosine, -1, 1)))
        np.add.at(sums, faces[:, corner], angles[:, None] * normals)
    return unit(sums)


def _checked(value: Any, name: str, count: int) -> NDArray[np.float64]:
    normals = float_points(value, name)
    if len(normals) != count:
        raise error_of("arraySize", f"{name} has {len(normals)} rows, not {count}")
    return normals


def _corners(mesh: Any) -> NDArray[np.float64]:
    corners: NDArray[np.float64] = float_points(mesh.vertices, "vertices")[np.asarray(mesh.faces)].transpose(1, 0, 2)
    return corners


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scales rows to length 1; a row of length 0 becomes NaN."""
    with np.errstate(invalid="ignore"):
        scaled: NDArray[np.float64] = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return scaled

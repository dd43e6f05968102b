from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Mesh = tuple[NDArray[Any], NDArray[Any]]

_CUBE_CORNERS = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
_CUBE_QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def cube() -> Mesh:
    """The unit cube, with 12 faces."""
    faces = [[a, b, c] for q in _CUBE_QUADS for a, b, c in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
    return np.array(_CUBE_CORNERS, np.float64), np.array(faces, np.int32)


def sphere(subdivisions: int = 3, radius: float = 1) -> Mesh:
    """A sphere of 20 * 4**subdivisions faces, from an icosahedron."""
    t = (1 + 5**0.5) / 2
    points: list[tuple[float, ...]] = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t)]
    points += [(t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2)]
    faces += [(10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5)]
    faces += [(2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    vertices, triangles = np.array(points, np.float64), np.array(faces, np.int64)
    for _ in range(subdivisions):
        vertices, triangles = _subdivided(vertices, triangles)
    vertices *= radius / np.linalg.norm(vertices, axis=1, keepdims=True)
    return vertices, triangles.astype(np.int32)


def tube(side_count: int, radius: float, length: float) -> Mesh:
    """A closed prism along z, around the origin, of 4 * side_count faces."""
    angles = 2 * np.pi * np.arange(side_count) / side_count
    ring = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    low, high = (np.column_stack([ring, np.full(side_count, z)]) for z in (-length / 2, length / 2))
    vertices = np.concatenate([low, high, [[0, 0, -length / 2], [0, 0, length / 2]]])
    i = np.arange(side_count)
    j, n = (i + 1) % side_count, side_count
    parts = [(i, j, j + n), (i, j + n, i + n), (j, i, np.full(n, 2 * n)), (i + n, j + n, np.full(n, 2 * n + 1))]
    return vertices, np.concatenate([np.stack(part, axis=1) for part in parts]).astype(np.int32)


def _subdivided(vertices: NDArray[Any], faces: NDArray[Any]) -> Mesh:
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, index = np.unique(edges, axis=0, return_inverse=True)
    middle = len(vertices) + index.reshape(-1, 3)
    a, b, c = faces.T
    ab, bc, ca = middle.T
    parts = [np.stack(part, axis=1) for part in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
    return np.concatenate([vertices, vertices[unique].mean(axis=1)]), np.stack(parts, axis=1).reshape(-1, 3)


def dumbbell() -> Mesh:
    """One closed surface with two parts: two bodies of different thickness, joined by a thin neck."""
    vertices, faces = sphere(4)
    radius = np.interp(vertices[:, 0], [-1, -0.5, -0.2, 0.2, 0.5, 1], [0.5, 0.5, 0.2, 0.2, 1, 1])
    vertices = vertices.copy()
    vertices[:, 1:] *= radius[:, None]
    vertices[:, 0] *= 3
    return vertices, faces


def joined(*meshes: Mesh) -> Mesh:
    """Returns one mesh that consists of the given meshes, side by side."""
    offsets = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    faces = [faces + offset for (_, faces), offset in zip(meshes, offsets)]
    return np.concatenate([vertices for vertices, _ in meshes]), np.concatenate(faces).astype(np.int32)

"""Minimal readers of PLY, STL, OFF and OBJ. They share no code with the library, and refuse what they do not need.

Polygons are cut as fans, so a verifier must treat the triangles of one face as one plane.
"""

from __future__ import annotations

import pathlib
import typing

import numpy as np


class Mesh(typing.NamedTuple):
    corners: np.ndarray  # (n, 3, 3) of triangles.
    face_of: np.ndarray  # For each triangle the index of its input face.
    face_count: int  # Input faces; those with fewer than three corners have no triangle.


_PLY_TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
              "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
              "double": "f8", "float64": "f8"}


def _mesh_of(vertices: np.ndarray, faces: list[list[int]]) -> Mesh:
    triangles = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
    face_of = [index for index, face in enumerate(faces) for _ in range(1, len(face) - 1)]
    indices = np.array(triangles, int).reshape(-1, 3)
    return Mesh(np.asarray(vertices, float)[indices], np.array(face_of, int), len(faces))


def _ply_elements(header: list[list[str]]) -> list[tuple[str, int, list[list[str]]]]:
    elements: list[tuple[str, int, list[list[str]]]] = []
    for words in header:
        if words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    return elements


class _PlyBody:
    """The numbers of a PLY file, in order."""

    def __init__(self, data: bytes, order: str | None) -> None:
        self.data, self.order, self.at = data, order, 0
        self.words = iter(data.split()) if order is None else None

    def take(self, kind: str, count: int) -> list[float]:
        if self.words is not None:
            return [float(next(self.words)) for _ in range(count)]
        kind = self.order + _PLY_TYPES[kind]
        numbers = np.frombuffer(self.data, kind, count, self.at)
        self.at += numbers.nbytes
        return numbers.tolist()

    def row(self, properties: list[list[str]]) -> dict[str, list[float]]:
        values = {}
        for words in properties:
            count = 1
            if words[0] == "list":
                count = int(self.take(words[1], 1)[0])
            values[words[-1]] = self.take(words[-2], count)
        return values


def _read_ply(data: bytes) -> Mesh:
    head, _, body = data.partition(b"end_header\n")
    header = [line.split() for line in head.decode().splitlines()]
    order = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}[header[1][1]]
    numbers = _PlyBody(body, order)
    vertices, faces = [], []
    for name, count, properties in _ply_elements(header):
        for _ in range(count):
            row = numbers.row(properties)
            if name == "vertex":
                vertices.append([row[axis][0] for axis in "xyz"])
            elif name == "face":
                corners = row.get("vertex_indices") or row["vertex_index"]
                faces.append([int(corner) for corner in corners])
    return _mesh_of(np.array(vertices), faces)


def _read_stl(data: bytes) -> Mesh:
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * count:
        row = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        corners = np.frombuffer(data, row, count, 84)["corners"].astype(float)
    else:
        words = data.decode().split()
        numbers = [[float(x) for x in words[i + 1:i + 4]] for i, word in enumerate(words) if word == "vertex"]
        corners = np.array(numbers, np.float32).astype(float).reshape(-1, 3, 3)
    return Mesh(corners, np.arange(len(corners)), len(corners))


def _read_off(data: bytes) -> Mesh:
    words = [word for line in data.decode().splitlines() for word in line.partition("#")[0].split()]
    if words[0] != "OFF":
        raise ValueError("the first word of an OFF file must be OFF")
    vertex_count, face_count, at = int(words[1]), int(words[2]), 4
    vertices = np.array(words[at:at + 3 * vertex_count], float).reshape(-1, 3)
    at += 3 * vertex_count
    faces = []
    for _ in range(face_count):
        size = int(words[at])
        faces.append([int(word) for word in words[at + 1:at + 1 + size]])
        at += 1 + size
    return _mesh_of(vertices, faces)


def _read_obj(data: bytes) -> Mesh:
    vertices, faces = [], []
    for line in data.decode().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            faces.append([corner - 1 if corner > 0 else len(vertices) + corner for corner in corners])
    return _mesh_of(np.array(vertices), faces)


def joined(meshes: list[Mesh]) -> Mesh:
    """The faces of all meshes, one after another."""
    first_faces = np.cumsum([0, *(mesh.face_count for mesh in meshes)])
    face_of = [mesh.face_of + first for mesh, first in zip(meshes, first_faces[:-1], strict=True)]
    return Mesh(np.concatenate([mesh.corners for mesh in meshes]), np.concatenate(face_of), int(first_faces[-1]))


def read_mesh(path: pathlib.Path | str) -> Mesh:
    """Reads the corners of all triangles, in file order. Throws ValueError for other extensions."""
    path = pathlib.Path(path)
    readers = {".ply": _read_ply, ".stl": _read_stl, ".off": _read_off, ".obj": _read_obj}
    if path.suffix.lower() not in readers:
        raise ValueError(f"{path}: only PLY, STL, OFF and OBJ can be verified")
    return readers[path.suffix.lower()](path.read_bytes())

"""A shape of polygons: an L of quads with caps of six corners, which are concave, and a pyramid with a pentagon."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def shape() -> tuple[NDArray[np.float64], list[list[int]]]:
    """Vertices, and the corners of each face, counter-clockwise seen from outside."""
    outline = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)]
    vertices = [(x, y, z) for z in (0.0, 0.5) for x, y in outline]
    faces = [list(range(5, -1, -1)), list(range(6, 12))]
    faces += [[i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i] for i in range(6)]
    angles = np.arange(5) * 2 * np.pi / 5
    base = len(vertices)
    vertices += [(6 + float(np.cos(a)), float(np.sin(a)), 0.0) for a in angles] + [(6.0, 0.0, 1.2)]
    faces.append([base + i for i in range(4, -1, -1)])
    faces += [[base + i, base + (i + 1) % 5, base + 5] for i in range(5)]
    return np.array(vertices), faces


def write_ply(path: str, vertices: NDArray[np.float64], faces: list[list[int]]) -> None:
    """Coordinates in double, so that they are read as they are."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    lines += [f"property double {axis}" for axis in "xyz"]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(repr(float(number)) for number in vertex) for vertex in vertices]
    lines += [" ".join(map(str, [len(face), *face])) for face in faces]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")

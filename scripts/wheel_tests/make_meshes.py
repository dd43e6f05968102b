"""Makes ten meshes. asdf-vk-generate makes closed meshes; from these, the script makes open and composed meshes.

usage: make_meshes.py GENERATOR FOLDER
"""

from __future__ import annotations

import pathlib
import subprocess
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import asdf_vk

CLOSED = {"animal": 6000, "hand": 4000, "figure": 12000, "icosphere": 1280, "slab": 300, "torus": 2400}  # faces


class Surface:
    def __init__(self, vertices: NDArray[np.float64], faces: NDArray[Any]) -> None:
        self.vertices = vertices
        self.faces = faces

    def without(self, share: float) -> Surface:
        """Returns an open surface: leaves out a share of the faces, namely the faces with the greatest x."""
        x = self.vertices[self.faces].mean(axis=1)[:, 0]
        return Surface(self.vertices, self.faces[x <= np.quantile(x, 1 - share)])

    def shifted(self, lengths: float) -> Surface:
        """Returns the surface moved along x by a multiple of the length of its bounding box."""
        return Surface(self.vertices + [lengths * np.ptp(self.vertices[:, 0]), 0, 0], self.faces)

    def beside(self, other: Surface) -> Surface:
        """Returns both surfaces as one mesh."""
        faces = np.concatenate([self.faces, other.faces + len(self.vertices)])
        return Surface(np.concatenate([self.vertices, other.vertices]), faces)

    def write(self, path: pathlib.Path) -> None:
        lines = ["OFF", f"{len(self.vertices)} {len(self.faces)} 0"]
        lines += [" ".join(map(repr, vertex)) for vertex in self.vertices.tolist()]
        lines += [f"3 {a} {b} {c}" for a, b, c in self.faces.tolist()]
        path.write_text("\n".join(lines) + "\n")


def main(generator: str, folder: pathlib.Path) -> None:
    surfaces = {}
    for shape, face_count in CLOSED.items():
        path = folder / f"{shape}.ply"
        subprocess.run([generator, shape, "--faces", str(face_count), "-o", path], check=True)
        mesh = asdf_vk.read_mesh(path)
        surfaces[shape] = Surface(mesh.vertices, mesh.faces)
    animal, hand, torus = surfaces["animal"], surfaces["hand"], surfaces["torus"]
    made = {
        "open-animal": animal.without(0.2),
        "open-torus": torus.without(0.5),
        "three-components": hand.beside(torus.shifted(3)).beside(torus.shifted(-3)),
        "open-and-closed": hand.without(0.1).beside(animal.shifted(2)),
    }
    for name, surface in made.items():
        surface.write(folder / f"{name}.off")


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))

#!/usr/bin/python3
"""Compares asdf_vk.compat.meshparty with MeshParty's definition in NumPy: values, and CPU seconds on one core.

    PYTHONPATH=build/develop/python bench/meshparty_speed.py [--generate build/develop/src/asdf-vk-generate] [--points 400]

The ten generated meshes have about 4,000 faces and a size of 200 units. python/tests/meshparty_oracle.py (the oracle)
computes the definition: a loop over vertices that tests each ray against all triangles. MeshParty itself traces rays
with Embree. Therefore the program also prints the time of the oracle without tracing. The column "noise" has
differences of the oracle between the mesh and a copy with vertices in float32, because Embree computes in float32.
Needs python3-numpy.
"""

from __future__ import annotations

import argparse
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python/tests"))

import asdf_vk  # noqa: E402
from asdf_vk.compat import meshparty  # noqa: E402
from meshparty_oracle import Oracle, TrimeshLike  # noqa: E402

SHAPES = ("animal", "hand", "figure", "tree", "sphere", "icosphere", "slab", "cylinder", "torus", "cube")


def mesh_of(generate: str, shape: str, face_count: int) -> tuple[np.ndarray, np.ndarray]:
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "mesh.ply")
        subprocess.run([generate, shape, "--faces", str(face_count), "-o", path], check=True, capture_output=True)
        mesh = asdf_vk.read_mesh(path)
    return mesh.vertices * (200 / np.ptp(mesh.vertices, axis=0).max()), np.array(mesh.faces)


def differences(values: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Returns relative differences. A difference is infinite if only one of the two values exists."""
    both = np.abs(values / others - 1)
    both[np.isnan(values) & np.isnan(others)] = 0
    return np.nan_to_num(both, nan=np.inf)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--generate", default=str(ROOT / "build/develop/src/asdf-vk-generate"))
    parser.add_argument("--faces", type=int, default=4000)
    parser.add_argument("--points", type=int, default=400, help="number of computed vertices per mesh")
    given = parser.parse_args()
    session = asdf_vk.Session(backend="cpu", threads=1)
    print("mesh       faces  NaN  | median and greatest difference: ours     | of the noise          |"
          " CPU s: NumPy  without rays  ours   ratio  without rays")
    for shape in SHAPES:
        mesh = TrimeshLike(mesh_of(given.generate, shape, given.faces))
        inds = np.unique(np.linspace(0, len(mesh.vertices) - 1, given.points).astype(int))
        oracle, again = Oracle(), TrimeshLike((mesh.vertices.astype(np.float32), mesh.faces))
        expected = oracle.values(inds, mesh)
        noise = differences(Oracle().values(inds, again), expected)
        seconds = []
        for _ in range(7):
            begin = time.process_time()
            found = meshparty.shape_diameter_function(inds, mesh, session=session)
            seconds.append(time.process_time() - begin)
        own, whole = sorted(seconds)[3], oracle.ray_seconds + oracle.other_seconds
        off = differences(found, expected)
        print(f"{shape:9}  {len(mesh.faces):5}  {np.isnan(found).sum():3}  | {np.median(off):.1e}  {off.max():.1e}"
              f"{'':21} | {np.median(noise):.1e}  {noise.max():.1e}    |"
              f" {whole:11.2f}  {oracle.other_seconds:12.3f}  {own:.4f}  {whole / own:5.0f}  {oracle.other_seconds / own:5.1f}")


if __name__ == "__main__":
    main()

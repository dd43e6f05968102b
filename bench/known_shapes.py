#!/usr/bin/python3
"""Prints the tables of docs/accuracy.md for generated meshes: shapes with known values, and the animal.

    bench/known_shapes.py [--faces 1310720] [--backend auto] [--build build/develop]

--faces: greatest number of faces of a mesh; larger meshes are left out. Needs python3-numpy. The exact values are for a
smooth sphere, an infinite slab and an infinite smooth cylinder. NumPy computes them by the definition of
docs/method.md. The animal has no exact values; it is compared with the reference.
"""
from __future__ import annotations

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
RAY_COUNT = 30
SIZES = [320 * 4**level for level in range(7)]
ANIMAL_FACES = 100_000
SAMPLE = 4_000  # Number of faces with rays on large shapes.
HEAD = "|     faces | measured | median   | mean     | max      | order |\n" \
       "|----------:|---------:|---------:|---------:|---------:|------:|"


def cone(degrees: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For each ray: angle to the axis, angle around the axis, weight."""
    i = np.arange(RAY_COUNT)
    to_axis = np.arccos(1 - (i + 0.5) / RAY_COUNT * (1 - np.cos(np.radians(degrees) / 2)))
    return to_axis, i * np.pi * (3 - np.sqrt(5)), 1 / to_axis


def directions(normals: np.ndarray, degrees: float) -> np.ndarray:
    """Returns (m, rays, 3): the directions of the rays of each face."""
    z = -normals
    sign = np.where(z[:, 2] < -0.7, -1.0, 1.0)
    a = -1 / (sign + z[:, 2])
    b = z[:, 0] * z[:, 1] * a
    t1 = np.stack([1 + sign * z[:, 0] ** 2 * a, sign * b, -sign * z[:, 0]], 1)
    t2 = np.stack([b, sign + z[:, 1] ** 2 * a, -z[:, 1]], 1)
    to_axis, around, _ = cone(degrees)
    sine = np.sin(to_axis)
    return (np.einsum("r,mk->mrk", sine * np.cos(around), t1) + np.einsum("r,mk->mrk", sine * np.sin(around), t2) +
            np.einsum("r,mk->mrk", np.cos(to_axis), z))


def mean(lengths: np.ndarray, hit_cosines: np.ndarray, degrees: float) -> np.ndarray:
    """Returns (m,): weighted means without false hits and outliers. lengths, hit_cosines (n_f . n_g): (m, rays)."""
    lengths = np.where(hit_cosines > 1e-3, np.nan, lengths)
    median = np.nanmedian(lengths, 1, keepdims=True)
    kept = np.abs(lengths - median) <= np.nanstd(lengths, 1, keepdims=True) + 1e-5 * median
    weights = np.where(kept, cone(degrees)[2], 0)
    return np.nansum(weights * lengths, 1) / weights.sum(1)


def of_sphere(_: np.ndarray, normals: np.ndarray, degrees: float) -> np.ndarray:
    to_axis = cone(degrees)[0][None]
    return np.broadcast_to(mean(2 * np.cos(to_axis), -np.cos(2 * to_axis), degrees), len(normals))


def of_slab(_: np.ndarray, normals: np.ndarray, degrees: float) -> np.ndarray:
    to_axis = cone(degrees)[0][None]
    return np.broadcast_to(mean(0.1 / np.cos(to_axis), np.full_like(to_axis, -1), degrees), len(normals))


def of_cylinder(centres: np.ndarray, normals: np.ndarray, degrees: float) -> np.ndarray:
    """Values of an infinite cylinder of radius 0.25 around z, at its points nearest to the barycentres `centres`."""
    rays = directions(normals, degrees)[..., :2]
    start = centres[:, :2] * 0.25 / np.hypot(*centres[:, :2].T)[:, None]
    lengths = -2 * np.einsum("mrk,mk->mr", rays, start) / (rays**2).sum(2)
    hits = start[:, None] + rays * lengths[..., None]
    return mean(lengths, np.einsum("mrk,mk->mr", hits / 0.25, normals[:, :2]), degrees)


# For each shape: name, function of the exact values, and function that selects faces. A selected face is so far from
# rim and caps that its rays do not hit them.
SHAPES = {
    "icosphere": ("Sphere, radius 1", of_sphere, lambda c, n, degrees: np.ones(len(c), bool)),
    "slab": ("Slab, 2 x 2 x 0.1, only faces at least 0.19 away from the rim", of_slab,
             lambda c, n, degrees: (np.abs(n[:, 2]) > 0.9) & (np.abs(c[:, :2]).max(1) < 0.81)),
    "cylinder": ("Cylinder, radius 0.25, length 5, only faces at least {} away from the caps", of_cylinder,
                 lambda c, n, degrees: (np.abs(n[:, 2]) < 0.1) & (np.abs(c[:, 2]) < (1.55 if degrees > 80 else 2.04))),
}


def read_ply(path: pathlib.Path) -> tuple[np.ndarray, np.ndarray]:
    """Reads vertices and faces from a file of asdf-vk-generate."""
    head, _, data = path.read_bytes().partition(b"end_header\n")
    counts = [int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element")]
    vertices = np.frombuffer(data, "<f4", 3 * counts[0]).reshape(-1, 3)
    row = np.dtype([("n", "u1"), ("v", "<i4", 3), ("diameter", "<f4"), ("part", "<i4")])
    return vertices.astype(float), np.frombuffer(data, row, counts[1], vertices.nbytes)["v"]


class Programs:
    def __init__(self, build: pathlib.Path, backend: str, folder: pathlib.Path) -> None:
        self.asdf_vk = os.environ.get("ASDF_VK_PROGRAM", build / "src/asdf-vk")
        self.generator = os.environ.get("ASDF_VK_GENERATE", build / "src/asdf-vk-generate")
        self.backend, self.folder = backend, folder

    def generate(self, shape: str, face_count: int) -> pathlib.Path:
        path = self.folder / "mesh.ply"
        subprocess.run([self.generator, shape, "--faces", str(face_count), "-o", path], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return path

    def compute(self, mesh: pathlib.Path, *options: str) -> str:
        """Computes result.npz; returns the standard output."""
        return subprocess.run([self.asdf_vk, mesh, "--backend", self.backend, "--quiet", "-o", self.folder / "result.npz",
                               *options], check=True, text=True, stdout=subprocess.PIPE).stdout

    def traced(self, mesh: pathlib.Path, face_count: int, degrees: float) -> tuple[np.ndarray, np.ndarray]:
        """Returns values and the indices of traced faces: all faces, or random ones."""
        sample = ["--seeds", "all"] if face_count < 2 * SAMPLE else [
            "--seeds", str(SAMPLE), "--sampler", "random", "--guidance", "none", "--no-estimate", "--max-iterations", "1"]
        self.compute(mesh, "--angle", f"{degrees:g}", *sample)
        result = np.load(self.folder / "result.npz")
        return result["sdf"].astype(float), result["seed"] == 1


def size(error: float) -> str:
    return "< 1e-06 " if error < 1e-6 else f"{error:.2e}"


def print_shape(programs: Programs, shape: str, degrees: float, sizes: list[int]) -> None:
    name, exact, is_inner = SHAPES[shape]
    print(f"\n{name.format(0.95 if degrees > 80 else 0.46)}, cone of {degrees:g} degrees:\n\n{HEAD}")
    before = None
    for wanted in sizes:
        mesh = programs.generate(shape, wanted)
        vertices, faces = read_ply(mesh)
        corners = vertices[faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        centres = corners.mean(1)
        values, is_traced = programs.traced(mesh, len(faces), degrees)
        inner = np.flatnonzero(is_inner(centres, normals, degrees) & is_traced)
        expected = np.concatenate([exact(centres[chunk], normals[chunk], degrees)
                                   for chunk in np.array_split(inner, len(inner) // 50_000 + 1)])
        errors = np.abs(values[inner] / expected - 1)
        median, face_count = float(np.median(errors)), len(faces)
        order = "-"
        if before and median > 1e-6:
            order = f"{2 * np.log(before[1] / median) / np.log(face_count / before[0]):.2f}"
        print(f"| {face_count:9,} | {len(inner):8,} | {size(median)} | {size(errors.mean())} | {size(errors.max())} | {order:>5} |",
              flush=True)
        before = (face_count, median)


def print_animal(programs: Programs) -> None:
    check = json.loads(programs.compute(programs.generate("animal", ANIMAL_FACES), "--seeds", "all", "--check=all", "--json"))["check"]
    share = check["agreeingCount"] / check["tracedCount"]
    print(f"\nAnimal against the reference, over the diagonal:\n\n| faces | faces within 1e-4 | median | worst |\n|---|---|---|---|\n"
          f"| {check['comparedCount']:,} | {share:.3%} | {check['medianDifference']:.1e} | {check['worstDifference']:.1e} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--faces", type=int, default=SIZES[-1])
    parser.add_argument("--backend", default="auto")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/develop")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(arguments.build, arguments.backend, pathlib.Path(folder))
        sizes = [count for count in SIZES if count <= arguments.faces]
        for shape, degrees in (("icosphere", 120), ("slab", 120), ("cylinder", 120), ("icosphere", 80), ("cylinder", 80)):
            print_shape(programs, shape, degrees, sizes)
        if ANIMAL_FACES <= arguments.faces:
            print_animal(programs)


if __name__ == "__main__":
    main()

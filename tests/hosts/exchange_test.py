"""Files of other programs, read by asdf-vk, and files of asdf-vk, read by Blender.

The values of each file have to be within 1e-6 of the diagonal of those of the same triangles as PLY, with transforms and
units applied. The triangles are those that a second reader finds in the file; they have to be the intended ones up to
the digits that the program writes. A program that is not installed is left out with a line.

    exchange_test.py FOLDER
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import gltf_decoder
import threemf_decoder
from checks import Checks
from polygons import write_ply

import asdf_vk

HERE = Path(__file__).resolve().parent
PROGRAM = Path(os.environ["ASDF_VK_PROGRAM"])
TOLERANCE = 1e-6
folder = Path(sys.argv[1]) / "exchange"
folder.mkdir(exist_ok=True)
checks = Checks("Exchange")


def call(*command: Any) -> bool:
    """Runs a program of another project; a failure is a failed check."""
    result = subprocess.run([str(word) for word in command], cwd=folder, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, timeout=100)  # fmt: skip
    if result.returncode != 0:
        checks.that(f"{' '.join(map(str, command))}: {result.stdout[-600:]}", False)
    return result.returncode == 0


def has(program: str) -> bool:
    if shutil.which(program) is None:
        print(f"exchange: {program} is not installed, left out")
    return shutil.which(program) is not None


def values_of(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Barycentres, and the shape diameter and the thickness of the program."""
    output = path.with_suffix(path.suffix + ".npz")
    subprocess.run([PROGRAM, path, "--measure", "both", "--seeds", "all", "--fields", "sdf,thickness", "-o", output],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    mesh, arrays = asdf_vk.read_mesh(path), np.load(output)
    return mesh.vertices[mesh.faces].mean(axis=1), np.stack([arrays["sdf"], arrays["thickness"]], axis=1).astype(float)


def nearest_to(places: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Of each place, the number of the nearest expected one."""
    blocks = np.array_split(places, 40)
    return np.concatenate([np.square(block[:, None] - expected[None]).sum(axis=2).argmin(axis=1) for block in blocks])


def compare(name: str, intended: np.ndarray, digits: float = 1e-6, anywhere: bool = False) -> None:
    """A file against the same triangles as PLY, and against the intended ones, in any order.

    digits: rounding of the writer, of the diagonal. anywhere: the writer moves the mesh.
    """
    decode = {".glb": gltf_decoder.corners_of, ".gltf": gltf_decoder.corners_of, ".3mf": threemf_decoder.corners_of}
    corners = decode.get(Path(name).suffix, lambda path: intended)(folder / name)
    middle, aim = ((c.min(axis=(0, 1)) + c.max(axis=(0, 1))) / 2 if anywhere else 0 for c in (corners, intended))
    places, aims = corners.mean(axis=1) - middle, intended.mean(axis=1) - aim
    off = np.linalg.norm(places - aims[nearest_to(places, aims)], axis=1).max() / np.linalg.norm(np.ptp(aims, axis=0))
    checks.that(f"{name}: {off:.2g} of the diagonal from the intended places", off < digits)
    reference = folder / f"{name}.reference.ply"
    points, faces = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    write_ply(str(reference), points, faces.reshape(-1, 3).tolist())
    (places, values), (expected_places, expected) = values_of(folder / name), values_of(reference)
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    if len(places) != len(expected_places):
        return checks.that(f"{name}: {len(places)} instead of {len(expected_places)} faces", False)
    nearest = nearest_to(places, expected_places)
    distance = float(np.linalg.norm(places - expected_places[nearest], axis=1).max()) / diagonal
    checks.that(f"{name}: a face is {distance:.2g} of the diagonal away", distance < TOLERANCE)
    checks.that(f"{name}: {len(set(nearest))} of {len(places)} faces", len(set(nearest)) == len(places))
    difference = np.abs(values - expected[nearest]) / diagonal
    same_gaps = (np.isnan(values) == np.isnan(expected[nearest])).all()
    worst = np.nanmax(difference, axis=0)
    print(f"exchange: {name}: {len(places)} faces, worst difference sdf {worst[0]:.2g}, thickness {worst[1]:.2g}")
    return checks.that(f"{name}: differences {worst}", same_gaps and (worst < TOLERANCE).all())


def refused(name: str, text: str) -> None:
    checks.raises(name, asdf_vk.InputError, lambda: asdf_vk.read_mesh(folder / name), text)


def placed(corners: np.ndarray, matrix: Any) -> np.ndarray:
    matrix = np.asarray(matrix, np.float64)
    moved = corners @ matrix[:3, :3].T + matrix[:3, 3]
    return moved[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else moved


subprocess.run([PROGRAM.parent / "asdf-vk-generate", "animal", "--faces", "1500", "-o", folder / "animal.ply"], check=True,
               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
animal = asdf_vk.read_mesh(folder / "animal.ply")
vertices = animal.vertices.astype(np.float32)
corners = vertices.astype(np.float64)[animal.faces]
np.save(folder / "animal.vertices.npy", vertices)
np.save(folder / "animal.faces.npy", animal.faces)
vertices.tofile(folder / "animal.f32")
animal.faces.astype(np.uint32).tofile(folder / "animal.u32")
asdf_vk.write(folder / "animal.obj", animal)
stl = np.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
stl["corners"] = corners
(folder / "animal.stl").write_bytes(b"\0" * 80 + np.uint32(len(corners)).tobytes() + stl.tobytes())

if has("assimp"):
    for name, kind in (("assimp.glb", "glb2"), ("assimp.3mf", "3mf"), ("assimp.stl", "stlb")):
        if call("assimp", "export", "animal.stl", name, f"-f{kind}"):
            compare(name, corners, 1e-5)
    if call("assimp", "export", "animal.stl", "assimp.gltf", "-fgltf2"):
        refused("assimp.gltf", "export as .glb")
if has("gltfpack"):
    if call("gltfpack", "-i", "animal.obj", "-o", "plain.glb", "-noq"):
        compare("plain.glb", corners)
    if call("gltfpack", "-i", "animal.obj", "-o", "quantised.glb", "-vp", "16"):
        compare("quantised.glb", corners, 1e-4)
    if call("gltfpack", "-i", "animal.obj", "-o", "compressed.glb", "-c"):
        refused("compressed.glb", "compressed by EXT_meshopt_compression")
compiler = shutil.which("c++")
if compiler and Path("/usr/include/tiny_gltf.h").exists():
    program = folder / "write-tinygltf"
    if call(compiler, "-std=c++20", "-w", HERE / "writers/tinygltf.cpp", "-o", program):
        for name in ("tinygltf.glb", "tinygltf.gltf"):
            if call(program, "animal.f32", "animal.u32", name):
                checks.that(f"{name}: unit", asdf_vk.read_mesh(folder / name).unit == "m")
                outer = [[2, 0, 0, 1], [0, 2, 0, 2], [0, 0, 2, 3], [0, 0, 0, 1]]
                # A rotation about z by the quaternion (0, 0, 0.6, 0.8): cosine 0.28, sine 0.96.
                inner = [[0.28, 0.96, 0, 0], [0.96, -0.28, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]
                compare(name, placed(placed(corners, inner), outer))
else:
    print("exchange: tinygltf is not installed, left out")
if compiler and Path("/usr/include/lib3mf").exists():
    program = folder / "write-lib3mf"
    if call(compiler, "-w", "-I/usr/include/lib3mf", HERE / "writers/lib3mf.cpp", "-o", program, "-l3MF"):
        if call(program, "animal.f32", "animal.u32", "lib3mf.3mf"):
            turned = placed(corners, [[0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, 30], [0, 0, 0, 1]])
            compare("lib3mf.3mf", 3 * np.concatenate([corners, turned]), 1e-5)
            checks.that("lib3mf.3mf: unit", asdf_vk.read_mesh(folder / "lib3mf.3mf").unit == "in")
else:
    print("exchange: lib3mf is not installed, left out")
if has("prusa-slicer"):
    options = ("--scale", "20", "--rotate", "30", "--rotate-x", "10", "--dont-arrange", "--loglevel", "0")
    if call("prusa-slicer", "--export-3mf", *options, "-o", "prusa.3mf", "animal.stl"):
        turn, tilt = np.radians(30), np.radians(10)
        about_z = [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
        about_x = [[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]
        matrix = np.eye(4)
        matrix[:3, :3] = 20 * np.array(about_z) @ np.array(about_x)
        compare("prusa.3mf", placed(corners, matrix), 1e-5, anywhere=True)
        checks.that("prusa.3mf: unit", asdf_vk.read_mesh(folder / "prusa.3mf").unit == "mm")

if has("blender"):
    for output, options in (
        ("parts.glb", ["--segment"]), ("parts.obj", ["--segment"]), ("parts.npz", ["--segment"]), ("values.glb", []),
        ("values.obj", []),
    ):  # fmt: skip
        subprocess.run([PROGRAM, folder / "animal.ply", *options, "-o", folder / output], check=True,
                       stderr=subprocess.DEVNULL)  # fmt: skip
    call("blender", "-b", "--python-use-system-env", "--factory-startup", "--python-exit-code", "3", "--python",
         HERE / "blender_exchange.py", "--", folder)  # fmt: skip
    checks.that("Blender writes a GLB", (folder / "blender.glb").exists())
    # Blender turns z up into y up.
    up = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
    both = [placed(placed(corners, matrix), up) for matrix in np.load(folder / "blender.matrices.npy")]
    for name in sorted(path.name for path in folder.glob("blender.gl*") if path.suffix in (".glb", ".gltf")):
        compare(name, np.concatenate(both))
    found = json.loads((folder / "blender.found.json").read_text())
    counts = np.bincount(np.load(folder / "parts.npz")["segment"]).tolist()
    size = np.ptp(vertices, axis=0)
    for name in ("parts.glb", "parts.obj"):
        read = found[name]
        checks.that(f"{name}: a material per part", sorted(read["materials"].values()) == sorted(counts))
        numbers = [int(material.replace("_", " ").split()[-1]) for material in read["materials"]]
        checks.that(f"{name}: faces of each", [counts[number] for number in numbers] == list(read["materials"].values()))
        for shading in ("viewport", "nodes"):
            colours = {tuple(round(c, 2) for c in colour) for colour in read[shading]}
            checks.that(f"{name}: colours of the materials, {shading}: {colours}", len(colours) == len(counts) > 2)
    for name in ("values.glb", "values.obj"):
        checks.that(f"{name}: colours {found[name]['colour_count']}", found[name]["colour_count"] > 100)
    for name, read in found.items():
        checks.that(f"{name}: {read['face_count']} faces", read["face_count"] == len(corners))
        checks.that(f"{name}: size {read['size']}", np.allclose(sorted(read["size"]), sorted(size), rtol=1e-4))
checks.finish()

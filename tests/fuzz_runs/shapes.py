"""Meshes at random: shapes of asdf-vk-generate, random solids, and what can be done to them."""

from __future__ import annotations

import dataclasses
import math
import pathlib
import random
import struct

from program import RANDOM_SOLIDS, Program

Vertex = tuple[float, float, float]

SHAPES = (
    *("animal", "hand", "figure", "sphere", "icosphere", "slab", "cylinder", "torus", "cube"),
    *("wedge", "blade", "spike", "stepped-plate", "drafted-rib", "pocket", "drafted-box"),
    *("round-cup", "bracket-4", "ligament-12", "flat-thread"),
    *RANDOM_SOLIDS,
)
SHAPES_WITH_FACES = frozenset(SHAPES[:9])


@dataclasses.dataclass
class Mesh:
    vertices: list[Vertex]
    faces: list[tuple[int, ...]]
    what: str

    def diagonal(self) -> float:
        finite = [v for v in self.vertices if all(map(math.isfinite, v))]
        sides = [max(c) - min(c) for c in zip(*finite)] if finite else [0.0]
        return math.hypot(*sides)


def generated(program: Program, rng: random.Random, folder: pathlib.Path, most_faces: int) -> Mesh:
    """A closed mesh of the generator."""
    shape = rng.choice(SHAPES)
    arguments = [shape]
    if shape in SHAPES_WITH_FACES:
        arguments += ["--faces", str(round(math.exp(rng.uniform(3, math.log(most_faces)))))]
    if shape in RANDOM_SOLIDS:
        arguments += ["--rng-seed", str(rng.randrange(10**6))]
    if shape == "assembly" and rng.random() < 0.2:
        arguments.append("--interpenetrate")
    return by_generator(program, arguments, folder)


def by_generator(program: Program, arguments: list[str], folder: pathlib.Path) -> Mesh:
    path = folder / "generated.ply"
    program.make(arguments, path)
    mesh = read_generated(path, " ".join(arguments))
    path.unlink()
    return mesh


def read_generated(path: pathlib.Path, what: str) -> Mesh:
    header, body = path.read_bytes().split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.split(b"\n") if line.startswith(b"element")]
    vertices = list(struct.iter_unpack("<3d", body[: 24 * counts[0]]))
    rows = struct.iter_unpack("<B3ifi", body[24 * counts[0] :])
    return Mesh(vertices, [row[1:4] for row in rows], what)


def write(mesh: Mesh, path: pathlib.Path) -> pathlib.Path:
    """As OFF, whose numbers read back the same."""
    lines = ["OFF", f"{len(mesh.vertices)} {len(mesh.faces)} 0"]
    lines += [" ".join(map(repr, vertex)) for vertex in mesh.vertices]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def has_contacts(mesh: Mesh) -> bool:
    """Whether faces of other triangles lie upon one another."""
    return mesh.what.startswith(RANDOM_SOLIDS)


def in_general_position(mesh: Mesh, rng: random.Random) -> Mesh:
    """On symmetric shapes rays hit edges and lengths are equal, so that rounding decides, rightly.
    Parts that touch and doubled faces stay as they are."""
    return mesh if has_contacts(mesh) else moved(mesh, rng, 2e-3)


def scaled(mesh: Mesh, factor: float) -> Mesh:
    vertices = [(x * factor, y * factor, z * factor) for x, y, z in mesh.vertices]
    return Mesh(vertices, mesh.faces, f"{mesh.what}, times {factor:g}")


def shifted(mesh: Mesh, diagonals: float) -> Mesh:
    d = diagonals * mesh.diagonal()
    vertices = [(x + d, y - d, z + d / 2) for x, y, z in mesh.vertices]
    return Mesh(vertices, mesh.faces, f"{mesh.what}, shifted by {diagonals:g} diagonals")


def opened(mesh: Mesh, rng: random.Random) -> Mesh:
    share = rng.uniform(0.01, 0.4)
    faces = [face for face in mesh.faces if rng.random() > share] or mesh.faces[:1]
    return Mesh(mesh.vertices, faces, f"{mesh.what}, open")


def turned_over(mesh: Mesh, rng: random.Random) -> Mesh:
    share = rng.choice((0.02, 0.5, 1.0))
    faces = [face[::-1] if rng.random() < share else face for face in mesh.faces]
    return Mesh(mesh.vertices, faces, f"{mesh.what}, faces turned over")


def repeated(mesh: Mesh, rng: random.Random) -> Mesh:
    chosen = [face for face in mesh.faces if rng.random() < 0.2]
    copies = [face if rng.random() < 0.5 else face[::-1] for face in chosen]
    return Mesh(mesh.vertices, mesh.faces + copies, f"{mesh.what}, faces repeated")


def doubled(mesh: Mesh, rng: random.Random) -> Mesh:
    """Each face twice, the second ones in the same order, with another first corner."""
    copies = []
    for face in mesh.faces:
        first = rng.randrange(len(face))
        copies.append(face[first:] + face[:first])
    return Mesh(mesh.vertices, mesh.faces + copies, f"{mesh.what}, each face twice")


def collapsed(mesh: Mesh, rng: random.Random) -> Mesh:
    """Faces without an area: corners on a common place, and the same corner twice."""
    vertices, faces = list(mesh.vertices), list(mesh.faces)
    for _ in range(1 + len(faces) // 20):
        a, b = rng.choice(faces)[:2]
        vertices[a] = vertices[b]
        f = rng.randrange(len(faces))
        if rng.random() < 0.5:
            faces[f] = (faces[f][0], faces[f][1], faces[f][1])
    return Mesh(vertices, faces, f"{mesh.what}, collapsed")


def noisy(mesh: Mesh, rng: random.Random) -> Mesh:
    return moved(mesh, rng, rng.choice((1e-9, 1e-5, 1e-2, 0.2)))


def moved(mesh: Mesh, rng: random.Random, diagonals: float) -> Mesh:
    d = diagonals * mesh.diagonal()
    uniform = rng.uniform
    vertices = [
        (x + uniform(-d, d), y + uniform(-d, d), z + uniform(-d, d)) for x, y, z in mesh.vertices
    ]
    return Mesh(vertices, mesh.faces, f"{mesh.what}, noise of {diagonals:g}")


def without_numbers(mesh: Mesh, rng: random.Random) -> Mesh:
    vertices = list(mesh.vertices)
    for _ in range(1 + len(vertices) // 50):
        bad = rng.choice((math.nan, math.inf, -math.inf))
        vertices[rng.randrange(len(vertices))] = (bad, 0.0, 1.0)
    return Mesh(vertices, mesh.faces, f"{mesh.what}, not finite")


def flattened(mesh: Mesh, rng: random.Random) -> Mesh:
    factor = rng.choice((0.0, 1e-12, 1e-6, 1e-3))
    vertices = [(x, y, z * factor) for x, y, z in mesh.vertices]
    return Mesh(vertices, mesh.faces, f"{mesh.what}, flat by {factor:g}")


def reordered(mesh: Mesh, rng: random.Random) -> Mesh:
    return Mesh(mesh.vertices, rng.sample(mesh.faces, len(mesh.faces)), f"{mesh.what}, reordered")


DEFECTS = (opened, turned_over, repeated, collapsed, noisy, without_numbers, flattened, reordered)


def odd(program: Program, rng: random.Random, folder: pathlib.Path, most_faces: int) -> Mesh:
    """A mesh with up to three defects, often in a strange unit or far from the origin."""
    mesh = generated(program, rng, folder, most_faces)
    for change in rng.sample(DEFECTS, rng.choice((0, 1, 1, 2, 3))):
        mesh = change(mesh, rng)
    if rng.random() < 0.1:
        mesh.faces = mesh.faces[: rng.choice((1, 2, 3))]
    if rng.random() < 0.3:
        mesh = scaled(mesh, 10 ** rng.uniform(-30, 30))
    if rng.random() < 0.2:
        mesh = shifted(mesh, 10 ** rng.uniform(0, 14))
    return mesh

"""Small meshes and broken files for batches."""
import pathlib

import numpy as np


def bumpy_sphere(face_count, rng):
    """Returns a closed mesh of about `face_count` faces: vertices (n, 3), faces (m, 3)."""
    rings = max(4, round((face_count / 4) ** 0.5))
    columns = 2 * rings
    theta = np.linspace(0, np.pi, rings + 1)[1:-1]
    phi = np.arange(columns) * 2 * np.pi / columns
    t, p = np.meshgrid(theta, phi, indexing="ij")
    radius = 1 + 0.3 * np.sin(rng.integers(1, 5) * p) * np.sin(rng.integers(1, 4) * t) ** 2
    grid = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], -1) * radius[..., None]
    vertices = np.concatenate([grid.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]]) * rng.uniform(0.1, 10, 3)
    top, bottom = len(vertices) - 2, len(vertices) - 1
    faces = []
    for c in range(columns):
        n = (c + 1) % columns
        faces.append((top, c, n))
        last = (rings - 2) * columns
        faces.append((bottom, last + n, last + c))
        for r in range(rings - 2):
            a, b = r * columns + c, r * columns + n
            faces.append((a, a + columns, b + columns))
            faces.append((a, b + columns, b))
    return vertices, np.array(faces)


def ply(vertices, faces):
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    return header.encode() + vertices.astype("<f4").tobytes() + rows.tobytes()


def off(vertices, faces):
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [f"{x:.6g} {y:.6g} {z:.6g}" for x, y, z in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    return ("\n".join(lines) + "\n").encode()


def broken(kind, vertices, faces):
    """Returns bytes and file extension of a mesh that cannot be read. `kind` selects one of several defects."""
    good_ply, good_off = ply(vertices, faces), off(vertices, faces)
    share = 0.02 + 0.96 * (kind // 10) / 10
    lines = good_off.split(b"\n")
    at = 2 + int(share * (len(lines) - 4))
    ways = [
        lambda: (good_ply[: int(share * len(good_ply))], "ply"),
        lambda: (b"\n".join(lines[:at]), "off"),
        lambda: (good_off.replace(b"3 ", b"3 9999999 ", 1) if kind < 10 else good_off + b"3 0 1 7777777\n", "off"),
        lambda: (b"\n".join(lines[:at] + [b"what is this"] + lines[at:]), "off"),
        lambda: (good_ply.replace(b"element vertex ", b"element vertex 9%d" % kind, 1), "ply"),
        lambda: (bytes((i * 37 + kind) % 251 for i in range(100 + kind)), "stl"),
        lambda: (good_ply + bytes(kind + 1), "ply"),
        lambda: (b"" if kind < 10 else b"\n" * kind, "obj"),
        lambda: (good_ply.replace(b"uchar int", b"uchar quaternion" if kind % 20 < 10 else b"float int", 1), "ply"),
        lambda: (f"OFF\n{kind} 0 0\n".encode() + b"0 0 0\n" * kind, "off"),
    ]
    return ways[kind % 10]()


def write_meshes(folder, count, hangs=False, grows=False):
    """Writes `count` meshes, 100 per folder. Returns the paths of the broken meshes."""
    rng = np.random.default_rng(1)
    failing = []
    for i in range(count):
        vertices, faces = bumpy_sphere(100 * 50 ** rng.random(), rng)
        path = folder / f"{i // 100:03d}" / f"m{i:05d}"
        path.parent.mkdir(parents=True, exist_ok=True)
        if i % 100 == 99:
            data, extension = broken(i // 100, vertices, faces)
            failing.append(f"{path}.{extension}")
        else:
            data, extension = (ply(vertices, faces), "ply") if i % 2 else (off(vertices, faces), "off")
            if (hangs and i == count // 3) or (grows and i == count // 2):
                path = path.with_name(path.name + ("-hang" if i == count // 3 else "-grow"))
                failing.append(f"{path}.{extension}")
        pathlib.Path(f"{path}.{extension}").write_bytes(data)
    return failing

#!/usr/bin/python3
"""Checks per second of the meshes of a tar, as `asdf-vk --tar` computes them.

    bench/tar_rate.py build/develop/src [--meshes 20000] [--format npy]

The folder has the programs. The tar has binary STLs of a cube, a bracket and six shapes of 500 faces in turn, or only
those of --shape; --shape can be repeated. Each row
has the meshes per second and the CPU milliseconds per mesh of all processes, which depend little on other programs, and
the greatest memory of a process.
"""

from __future__ import annotations

import argparse
import io
import json
import resource
import subprocess
import sys
import tarfile
import tempfile
import time
from pathlib import Path

LIMIT = 0.8
SHAPES = {
    "cube": ["thick-cube"],
    "bracket": ["bracket-4", "--longest-edge", "14"],
    **{shape: [shape, "--faces", "500"] for shape in ("cylinder", "torus", "slab", "sphere", "hand", "animal")},
}


def generated(programs: Path, shape: str) -> bytes:
    with tempfile.NamedTemporaryFile(suffix=".stl") as file:
        subprocess.run([programs / "asdf-vk-generate", *SHAPES[shape], "-o", file.name], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        return Path(file.name).read_bytes()


def write_tar(path: Path, meshes: list[bytes], count: int) -> None:
    with tarfile.open(path, "w") as tar:
        for i in range(count):
            info = tarfile.TarInfo(f"{i:06}.stl")
            content = meshes[i % len(meshes)]
            info.size = len(content)
            tar.addfile(info, io.BytesIO(content))


def children() -> tuple[float, int]:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime, used.ru_maxrss


def row(programs: Path, shapes: list[str], count: int, options: list[str]) -> str:
    with tempfile.TemporaryDirectory() as folder:
        source, answers = Path(folder) / "in.tar", Path(folder) / "out.tar"
        write_tar(source, [generated(programs, shape) for shape in shapes], count)
        cpu, begin = children()[0], time.perf_counter()
        with source.open("rb") as stream, answers.open("wb") as output:
            code = subprocess.run([programs / "asdf-vk", "--tar", "-", "-o", "-", "--fail-if-thinner", str(LIMIT),
                                   "--backend", "cpu", "--quiet", *options], stdin=stream, stdout=output,
                                  stderr=subprocess.DEVNULL, check=False).returncode  # fmt: skip
        passed = time.perf_counter() - begin
        used, memory = children()
        records, faces = 0, 0
        with tarfile.open(answers) as tar:
            for info in tar:
                if not info.name.endswith(".json"):
                    continue
                file = tar.extractfile(info)
                assert file is not None
                record = json.load(file)
                if record["error"] not in (None, "tooThin", "notJudged"):
                    sys.exit(f"{info.name}: {record['message']}")
                faces += record["faceCount"]
                records += 1
    if records != count or code not in (0, 5, 6):
        sys.exit(f"{records} of {count} records, exit code {code}")
    name = shapes[0] if len(shapes) == 1 else "all"
    return f"| {name} | {faces / count:.0f} | {count / passed:,.0f} | {1e3 * (used - cpu) / count:.2f} | {memory >> 10} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path)
    parser.add_argument("--meshes", type=int, default=20_000)
    parser.add_argument("--shape", action="append", choices=[*SHAPES, "all"])
    parser.add_argument("options", nargs="*", help="further options of asdf-vk, behind --")
    arguments = parser.parse_args()
    print("| shape | faces per mesh | meshes/s | CPU ms per mesh | MiB |\n|---|---|---|---|---|")
    for shape in arguments.shape or ["cube", "bracket", "all"]:
        shapes = list(SHAPES) if shape == "all" else [shape]
        print(row(arguments.programs, shapes, arguments.meshes, arguments.options), flush=True)


if __name__ == "__main__":
    main()

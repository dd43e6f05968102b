#!/usr/bin/python3
"""Checks per second of small meshes: a process per mesh, `asdf-vk serve`, and the Python module.

    PYTHONPATH=build/develop/python bench/calls_per_second.py build/develop/src

The folder has the programs. A check is {"thinnerThan": 0.8}, on the backend cpu. The server gets the next request
before the answer to the last one, so that it uses all cores; the other two run one check after another. Each cell
has the checks per second, and in brackets the CPU milliseconds per check, which depend little on other programs. Both
are medians of the rounds; a round runs the three in turn. Without the module asdf_vk, its column is empty.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

try:
    import asdf_vk
except ImportError:
    asdf_vk = None

LIMIT = 0.8
SHAPES = [("thick-cube", []), ("ribbed-plate", []), ("round-cup", []), ("bracket-4", ["--longest-edge", "14"])] + [
    (shape, ["--faces", str(count)])
    for count in (500, 10_000)
    for shape in ("cube", "cylinder", "torus", "slab", "sphere", "hand", "animal")
]


class Server:
    """A server with requests of one mesh."""

    def __init__(self, program: Path, mesh: Path) -> None:
        self.process = subprocess.Popen([program, "serve", "--backend", "cpu"], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE)  # fmt: skip
        self.line = json.dumps({"id": 1, "mesh": str(mesh), "options": {"thinnerThan": LIMIT}}).encode() + b"\n"
        self.run(4)

    def run(self, count: int) -> None:
        assert self.process.stdin is not None and self.process.stdout is not None
        self.process.stdin.write(self.line * count)
        self.process.stdin.flush()
        for _ in range(count):
            answer = self.process.stdout.readline()
            if b'"report":' not in answer:
                sys.exit(f"no report: {answer!r}")

    def cpu_seconds(self) -> float:
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def close(self) -> None:
        assert self.process.stdin is not None
        self.process.stdin.close()
        self.process.wait()


class Method:
    """A way to run checks, with the CPU time that it has used."""

    def __init__(self, work: Callable[[int], None], cpu_seconds: Callable[[], float]) -> None:
        self.work, self.cpu_seconds, self.count = work, cpu_seconds, 2
        self.count = max(2, int(0.4 / self.seconds()[0]))  # About 0.4 s per round.

    def seconds(self) -> tuple[float, float]:
        """Of one check: passed time, and CPU time."""
        cpu, begin = self.cpu_seconds(), time.perf_counter()
        self.work(self.count)
        return (time.perf_counter() - begin) / self.count, (self.cpu_seconds() - cpu) / self.count


def children_seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def rates(programs: Path, mesh: Path, rounds: int) -> tuple[int, list[str]]:
    program = programs / "asdf-vk"

    def by_command(count: int) -> None:
        for _ in range(count):
            subprocess.run([program, mesh, "--backend", "cpu", "--fail-if-thinner", str(LIMIT), "--quiet"],
                           check=False, stderr=subprocess.DEVNULL)  # fmt: skip

    server = Server(program, mesh)
    methods = [Method(by_command, children_seconds), Method(server.run, server.cpu_seconds)]
    face_count = int(json.loads(subprocess.run([program, mesh, "--backend", "cpu", "--thinner-than", str(LIMIT), "--json",
                                                "--quiet", "-o", "/dev/null", "--format", "npy"], check=True,
                                               stdout=subprocess.PIPE).stdout)["faceCount"])  # fmt: skip
    if asdf_vk is not None:
        read = asdf_vk.read_mesh(str(mesh))
        vertices, faces = read.vertices, read.faces

        def by_module(count: int) -> None:
            for _ in range(count):
                asdf_vk.thickness(vertices, faces, backend="cpu", thinner_than=LIMIT)

        methods.append(Method(by_module, time.process_time))
    found = [[method.seconds() for method in methods] for _ in range(rounds)]
    server.close()
    cells = []
    for of_method in zip(*found, strict=True):
        passed, cpu = (statistics.median(times) for times in zip(*of_method, strict=True))
        cells.append(f"{1 / passed:,.{0 if passed < 0.1 else 1}f} ({1e3 * cpu:.2g})")
    return face_count, cells


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path)
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    print("| shape | faces | command | serve | Python |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for shape, options in SHAPES:
            mesh = Path(folder) / f"{shape}.ply"
            subprocess.run([arguments.programs / "asdf-vk-generate", shape, *options, "-o", mesh], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
            faces, cells = rates(arguments.programs, mesh, arguments.rounds)
            print(f"| {shape} | {faces:,} | " + " | ".join(cells + ["-"] * (3 - len(cells))) + " |", flush=True)


if __name__ == "__main__":
    main()

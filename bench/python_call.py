"""Compares the times of asdf_vk.shape_diameter() on arrays and of Session::compute(), in turns.

    PYTHONPATH=build/develop/python /usr/bin/python3 bench/python_call.py build/develop/bench/asdfvk-bench-call MESH

Prints the median seconds of the two functions, and the median of the ratios Python / C++.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import time

import numpy as np

import asdf_vk

RUNS = 21


def main() -> None:
    program, path, *rest = sys.argv[1:]
    backend = rest[0] if rest else "auto"
    mesh = asdf_vk.read_mesh(path)
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    library = subprocess.Popen(
        [program, path, backend], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
    )
    assert library.stdin is not None and library.stdout is not None

    def of_library() -> float:
        assert library.stdin is not None and library.stdout is not None
        library.stdin.write("\n")
        return float(library.stdout.readline())

    def of_python() -> float:
        begin = time.perf_counter()
        asdf_vk.shape_diameter(vertices, faces, backend=backend)
        return time.perf_counter() - begin

    of_library(), of_python()
    pairs = [(of_python(), of_library()) if i % 2 else (of_library(), of_python())[::-1] for i in range(RUNS)]
    python, cpp = (statistics.median(times) for times in zip(*pairs))
    ratio = statistics.median(a / b for a, b in pairs)
    print(f"{path}, {len(faces)} faces, {backend}: Python {python:.4f} s, library {cpp:.4f} s, ratio {ratio:.3f}")


if __name__ == "__main__":
    main()

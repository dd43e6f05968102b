"""Time of asdf_vk.shape_diameter() on arrays over that of Session::compute(), in turns, and what is copied.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/python_call.py build/release/bench/asdfvk-bench-call MESH

Prints medians and the median of the ratios, then the growth of the peak of memory by arrays of the right type.
"""

from __future__ import annotations

import resource
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

    # The arrays of a mesh whose computation takes little: 4 million vertices, of which the faces use few.
    many = np.zeros((4_000_000, 3))
    many[: len(vertices)] = vertices
    few = faces[:12]
    for name, array in (("float64", many), ("float64, Fortran order", np.asfortranarray(many))):
        asdf_vk.shape_diameter(vertices, few, backend="reference")
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        try:
            asdf_vk.shape_diameter(array, few, backend="reference")
        except asdf_vk.Error as error:
            print(error)
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        print(f"{name}: array {array.nbytes / 1e6:.0f} MB, peak grows by {(after - before) / 1e3:.0f} MB")


if __name__ == "__main__":
    main()

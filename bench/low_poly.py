#!/usr/bin/python3
"""Measures the default options on 20 generated meshes of 688 to 12,040 faces: parts as from CAD programs, and shapes.

    bench/low_poly.py [--backend cpu] [--build build/develop]

Prints the table of bench/recipes for these meshes.
"""
from __future__ import annotations

import argparse
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Names for asdf-vk-generate, each with the option that sets its number of faces.
SHAPES = [(name, "--faces", count) for name, count in
          [("animal", 1_000), ("animal", 12_000), ("hand", 2_000), ("hand", 8_000), ("figure", 5_000), ("tree", 4_000)]]
PARTS = [(name, "--longest-edge", length) for name, length in
         [("wedge", 2), ("knife", 1), ("spike", 1), ("blade", 0.9), ("stepped-plate", 1), ("ribbed-plate", 2),
          ("drafted-rib", 2), ("pocket", 1), ("shelled-box", 2), ("drafted-box", 2), ("round-cup", 1),
          ("bracket-4", 0.5), ("bracket-16", 1), ("sharp-thread", 1)]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/develop")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        meshes = []
        for name, option, number in SHAPES + PARTS:
            meshes.append(f"{folder}/{name}-{number}.ply")
            subprocess.run([arguments.build / "src/asdf-vk-generate", name, option, str(number), "-o", meshes[-1]],
                           check=True, stdout=subprocess.DEVNULL)
        subprocess.run([arguments.build / "bench/asdfvk-bench-recipes", "--backend", arguments.backend, *meshes],
                       check=True)


if __name__ == "__main__":
    main()

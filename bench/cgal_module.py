#!/usr/bin/python3
"""Compares cgal_Segmentation_Module with CGAL 5.5.1: values from 0 to 1, and labels with expansion="first".

    PYTHONPATH=BUILD/python bench/cgal_module.py BUILD/bench/asdfvk-bench-cgal-oracle MESH...

Prints a row per mesh and setting (clusters, smoothness). A row has the greatest difference of two values, the share of
equal labels, the numbers of segments of asdf-vk and of CGAL, and the seconds of asdf-vk.
"""

from __future__ import annotations

import argparse
import pathlib
import subprocess
import time

import asdf_vk
import numpy as np
from cgal_Segmentation_Module import cgal_segmentation_arrays


def main() -> None:
    parser = argparse.ArgumentParser(description="Compares cgal_Segmentation_Module with CGAL.")
    parser.add_argument("oracle", help="asdfvk-bench-cgal-oracle")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--settings", default="5/0.26,3/0.2", help="clusters/smoothness,...")
    parser.add_argument("--backend", default="auto")
    arguments = parser.parse_args()
    print("| mesh | faces | k / smoothness | difference | equal labels | segments | of CGAL | s |")
    print("|---|---|---|---|---|---|---|---|")
    for path in map(pathlib.Path, arguments.meshes):
        mesh = asdf_vk.read_mesh(path)
        for setting in arguments.settings.split(","):
            clusters, smoothness = setting.split("/")
            command = [arguments.oracle, path, "--clusters", clusters, "--smoothness", smoothness]
            done = subprocess.run(command, check=True, capture_output=True, text=True)
            expected = np.loadtxt(done.stdout.splitlines())
            start = time.perf_counter()
            labels, values = cgal_segmentation_arrays(
                mesh,
                None,
                int(clusters),
                float(smoothness),
                expansion="first",
                backend=arguments.backend,
            )
            seconds = time.perf_counter() - start
            difference = np.abs(values - expected[:, 0]).max()
            equal = (labels == expected[:, 1]).mean()
            counts = f"{labels.max() + 1} | {int(expected[:, 1].max()) + 1}"
            row = [path.name, len(labels), setting, f"{difference:.2g}", f"{equal:.4%}", counts]
            print("| " + " | ".join(map(str, row)) + f" | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()

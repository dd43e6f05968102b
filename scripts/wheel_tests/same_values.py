"""Compares the values of the installed module with the values of the program asdf-vk, bit by bit.

usage: same_values.py FOLDER BACKEND... FOLDER contains meshes; MESH.BACKEND.npy has the values of the program for MESH.
Prints a table. Then checks that the module uses the libraries of the wheel, and that the default backend without a
Vulkan loader is "cpu".
"""

from __future__ import annotations

import pathlib
import sys
from typing import Literal

import numpy as np

import asdf_vk


Backend = Literal["reference", "cpu"]
BACKENDS: tuple[Backend, ...] = ("reference", "cpu")


class Failed(Exception):
    """A check failed; the text has the reason."""


def _compare(path: pathlib.Path, backend: Backend) -> str:
    expected = np.load(f"{path}.{backend}.npy")
    values = asdf_vk.shape_diameter(asdf_vk.read_mesh(path), backend=backend)
    if values.dtype != expected.dtype or values.shape != expected.shape:
        raise Failed(f"{path.name}, {backend}: {values.dtype} {values.shape} for {expected.dtype} {expected.shape}")
    # Compares bits, because NaN differs from itself.
    different = int(np.count_nonzero(values.view(np.uint32) != expected.view(np.uint32)))
    if different:
        raise Failed(f"{path.name}, {backend}: {different} of {len(values)} values are different")
    if not np.isfinite(values).any():
        raise Failed(f"{path.name}, {backend}: no value")
    return f"{len(values)} of {len(values)}"


def _check_libraries() -> None:
    """Checks that the libraries of the wheel are loaded from the wheel."""
    package = pathlib.Path(asdf_vk.__file__).parent
    maps = pathlib.Path("/proc/self/maps").read_text().splitlines()
    loaded = sorted({line.split()[-1] for line in maps if ".so" in line})
    for carried in sorted((package / "libs").iterdir()):
        name = carried.name.split("-")[0].split(".")[0]
        files = [file for file in loaded if pathlib.Path(file).name.startswith((f"{name}-", f"{name}."))]
        if str(carried) not in files:  # Python may have its own copy of a library, such as expat.
            raise Failed(f"{name} is loaded from {files}, not from {carried}")
        print(f"loaded: {carried}")


def _check_fallback(backend: str) -> None:
    """Checks that the default backend is "cpu", and that the session states the reason."""
    with asdf_vk.Session() as session:
        lines = session.device_lines
        expected = "vulkan: not available: no Vulkan loader (libvulkan.so.1) was found"
        if session.backend != backend or expected not in lines:
            raise Failed(f"the default backend is {session.backend}: {lines}")
        print(f"default backend: {'; '.join(lines)}")


def main(folder: pathlib.Path, names: list[str]) -> int:
    backends = [backend for backend in BACKENDS if backend in names]
    try:
        print(f"| mesh | {' | '.join(f'same bits, {backend}' for backend in backends)} |")
        print(f"|---|{'---|' * len(backends)}")
        for path in sorted(folder.iterdir()):
            if path.suffix != ".npy":
                cells = [_compare(path, backend) for backend in backends]
                print(f"| {path.name} | {' | '.join(cells)} |", flush=True)
        _check_libraries()
        _check_fallback(backends[-1])
    except (asdf_vk.Error, Failed) as error:
        print(f"same_values: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2:]))

"""Builds the extension asdf_vk._core with CMake; other settings are in pyproject.toml."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent


def version() -> str:
    """The version of the CMake project."""
    match = re.search(r"project\(asdf-vk VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())
    assert match is not None
    return match.group(1)


class BuildWithCMake(build_ext):
    """Further CMake arguments, for example -DCMAKE_BUILD_TYPE=Debug: in the environment variable CMAKE_ARGS."""

    def build_extension(self, extension: Extension) -> None:
        import pybind11

        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        build = Path(self.build_temp).resolve()
        build.mkdir(parents=True, exist_ok=True)
        configure = [
            # --fresh, because an earlier build in this folder may have had other options of CMAKE_ARGS.
            "cmake", "--fresh", "-S", str(SOURCE), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=0", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
            "-DASDF_VK_PYTHON=ON", "-DASDF_VK_PROGRAM=OFF", "-DASDF_VK_TESTS=OFF", "-DASDF_VK_BENCH=OFF",
            "-DASDF_VK_INSTALL=OFF", "-DASDF_VK_WERROR=OFF", f"-DPython_EXECUTABLE={sys.executable}",
            f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", f"-DASDF_VK_PYTHON_OUTPUT_DIR={target.parent}",
            # Make compiles a layer only after the layers that it links, so most of the time on one core.
            *(["-G", "Ninja"] if shutil.which("ninja") else []), *os.environ.get("CMAKE_ARGS", "").split(),
        ]  # fmt: skip
        subprocess.run(configure, check=True)
        jobs = str(self.parallel or os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", str(build), "--target", "asdfvk-python", "-j", jobs], check=True)


setup(version=version(), ext_modules=[Extension("asdf_vk._core", [])], cmdclass={"build_ext": BuildWithCMake})

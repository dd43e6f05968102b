"""Builds a wheel that contains its libraries; scripts/wheel describes the wheel and the options."""

from __future__ import annotations

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

from carry import carry, check, describe
from elf import MANYLINUX_LIBRARIES, NotPortable, dotted, highest, least_glibc
from licences import add_licences

# Packages whose headers are compiled into the module.
_HEADER_PACKAGES = ("libeigen3-dev", "libvulkan-dev", "libvulkan-volk-dev", "nlohmann-json3-dev", "python3-pybind11")
# Optional in other builds. A wheel contains the same libraries wherever it is built.
_REQUIRED = ("draco", "meshoptimizer")


def _say(text: str) -> None:
    print(f"wheel: {text}", file=sys.stderr, flush=True)


def _run(log: pathlib.Path, *command: str | pathlib.Path, cmake_args: str = "") -> None:
    environment = {**os.environ, "CMAKE_ARGS": f"{cmake_args} {os.environ.get('CMAKE_ARGS', '')}"}
    with log.open("a") as output:
        subprocess.run(command, check=True, stdout=output, stderr=subprocess.STDOUT, env=environment)


def _build(log: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    """Builds the wheel without libraries; it needs the libraries of this system."""
    # Removed, because setuptools would add files that an earlier build left in this folder.
    for left in pathlib.Path("build").glob("lib.*"):
        shutil.rmtree(left)
    options = ["--no-build-isolation", "--no-deps", "--no-index", f"--wheel-dir={folder}"]
    required = " ".join(f"-DCMAKE_REQUIRE_FIND_PACKAGE_{name}=ON" for name in _REQUIRED)
    _run(log, sys.executable, "-m", "pip", "wheel", ".", *options, cmake_args=required)
    return next(folder.glob("*.whl"))


def _complete(unpacked: pathlib.Path) -> None:
    """Adds libraries and licences to an unpacked wheel, and sets its tag."""
    module = next(unpacked.glob("asdf_vk/_core*.so"))
    information = next(unpacked.glob("*.dist-info"))
    folder = module.parent / "libs"
    carried = carry([module], folder, MANYLINUX_LIBRARIES)
    add_licences(information / "licenses", carried, _HEADER_PACKAGES)
    libraries = check([module], folder, MANYLINUX_LIBRARIES)
    versions = highest(libraries.values())
    for line in describe(libraries):
        _say(line)
    _say(f"  highest versions: {', '.join(f'{n} {dotted(v)}' for n, v in sorted(versions.items()))}")
    glibc = least_glibc(versions)
    platform = sysconfig.get_platform().replace("-", "_")
    tag = f"manylinux_{glibc[0]}_{glibc[1]}_{platform.removeprefix('linux_')}"
    description = information / "WHEEL"
    description.write_text(re.sub(rf"(?m)^(Tag: .*-){platform}$", rf"\g<1>{tag}", description.read_text()))


def main() -> int:
    parser = argparse.ArgumentParser(prog="scripts/wheel", description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="older wheels of asdf-vk in it are removed")
    folder: pathlib.Path = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    log = pathlib.Path("build/wheel.log")
    log.parent.mkdir(exist_ok=True)
    log.unlink(missing_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as name:
        work = pathlib.Path(name)
        try:
            _say("building the module, which takes some minutes the first time")
            plain = _build(log, work / "plain")
            _run(log, sys.executable, "-m", "wheel", "unpack", plain, "-d", work / "unpacked")
            unpacked = next((work / "unpacked").iterdir())
            _complete(unpacked)
            for old in folder.glob("asdf_vk-*.whl"):
                old.unlink()
            _run(log, sys.executable, "-m", "wheel", "pack", unpacked, "-d", folder)
        except subprocess.CalledProcessError as error:
            print("\n".join(log.read_text().splitlines()[-60:]), file=sys.stderr)
            _say(f"{error}; the log of the commands is {log}")
            return 1
        except NotPortable as error:
            _say(f"the wheel would not run on other systems: {error}")
            return 1
    wheel = next(folder.glob("asdf_vk-*.whl"))
    _say(f"{wheel}, {wheel.stat().st_size:,} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())

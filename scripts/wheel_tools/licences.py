"""Licences of the libraries of Debian in a wheel."""

from __future__ import annotations

import pathlib
import re
import shutil
import subprocess

# Packages whose headers are compiled into the module. The licences of copied libraries are found by their files.
HEADER_PACKAGES = ("libeigen3-dev", "libvulkan-dev", "libvulkan-volk-dev", "nlohmann-json3-dev", "python3-pybind11")
_COMMON = pathlib.Path("/usr/share/common-licenses")


def package_of(file: pathlib.Path) -> str:
    """The name of the Debian package that installed a file."""
    command = ["dpkg-query", "--search", str(file.resolve())]
    owner = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return owner.split(":")[0]


def _version(package: str) -> str:
    command = ["dpkg-query", "--show", "--showformat=${Version}\\n", package]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return output.split()[0]


def add_licences(folder: pathlib.Path, carried: dict[str, pathlib.Path]) -> None:
    """Writes licences: a file per package, the texts of /usr/share/common-licenses that they cite, and a list.

    `carried`: the original files of the libraries in the wheel. Keys are names in the wheel.
    """
    packages = {name: package_of(source) for name, source in carried.items()}
    folder.mkdir(parents=True, exist_ok=True)
    cited: set[str] = set()
    for package in sorted({*packages.values(), *HEADER_PACKAGES}):
        text = pathlib.Path("/usr/share/doc", package, "copyright").read_text()
        (folder / f"{package}.txt").write_text(text)
        cited.update(name.rstrip(".") for name in re.findall(rf"{_COMMON}/([\w.+-]+)", text))
    for name in sorted(cited):
        shutil.copyfile(_COMMON / name, folder / f"{name}.txt")
    lines = ["Libraries of Debian's packages in this wheel:"]
    lines += [f"  {name}: {package} {_version(package)}" for name, package in packages.items()]
    lines += ["Packages whose headers are compiled into the module:"]
    lines += [f"  {package} {_version(package)}" for package in HEADER_PACKAGES]
    lines += ["PACKAGE.txt has the licences of a package; texts that it cites", f"from {_COMMON} are here too."]
    (folder / "PACKAGES.txt").write_text("\n".join(lines) + "\n")

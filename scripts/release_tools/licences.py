"""Licences of the libraries of Debian in a package for other systems."""

from __future__ import annotations

import pathlib
import re
import shutil
import subprocess
from collections.abc import Iterable

from elf import NotPortable

_COMMON = pathlib.Path("/usr/share/common-licenses")


def package_of(file: pathlib.Path) -> str:
    """The name of the Debian package that installed a file."""
    path = str(file.resolve())
    # /lib is a link to /usr/lib, and some packages have the path with /lib.
    command = ["dpkg-query", "--search", path, path.removeprefix("/usr")]
    owners = subprocess.run(command, check=False, capture_output=True, text=True).stdout
    if not owners:
        raise NotPortable(f"no package has {path}, so its licence is unknown")
    return owners.split(":")[0]


def _version(package: str) -> str:
    command = ["dpkg-query", "--show", "--showformat=${Version}\\n", package]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return output.split()[0]


def add_licences(folder: pathlib.Path, carried: dict[str, pathlib.Path], header_packages: Iterable[str]) -> None:
    """Writes licences: a file per package, the texts of /usr/share/common-licenses that they cite, and a list.

    `carried`: the original files of the included libraries; keys are their names in the package. `header_packages`:
    packages whose headers are compiled in.
    """
    packages = {name: package_of(source) for name, source in carried.items()}
    folder.mkdir(parents=True, exist_ok=True)
    cited: set[str] = set()
    for package in sorted({*packages.values(), *header_packages}):
        text = pathlib.Path("/usr/share/doc", package, "copyright").read_text()
        (folder / f"{package}.txt").write_text(text)
        cited.update(name.rstrip(".") for name in re.findall(rf"{_COMMON}/([\w.+-]+)", text))
    for name in sorted(cited):
        shutil.copyfile(_COMMON / name, folder / f"{name}.txt")
    lines = ["Included libraries, and the packages of Debian that have them:"]
    lines += [f"  {name}: {package} {_version(package)}" for name, package in packages.items()]
    lines += ["Packages whose headers are compiled in:"]
    lines += [f"  {package} {_version(package)}" for package in header_packages]
    lines += ["PACKAGE.txt has the licences of a package; texts that it cites", f"from {_COMMON} are here too."]
    (folder / "PACKAGES.txt").write_text("\n".join(lines) + "\n")

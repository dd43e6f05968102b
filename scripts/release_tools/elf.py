"""Properties of shared libraries: the libraries that they need, and the manylinux tag that their symbols allow."""

from __future__ import annotations

import pathlib
import re
import subprocess
from collections.abc import Iterable
from typing import NamedTuple

Version = tuple[int, ...]

# Libraries of glibc. The portable folder may need only these.
GLIBC_LIBRARIES = frozenset({
    "libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "ld-linux-x86-64.so.2",
    "ld-linux-aarch64.so.1",
})  # fmt: skip
# Libraries that every manylinux system (PEP 600) has. The module may need them, and the wheel does not contain them.
# With a second copy of libstdc++ and libgcc_s, an exception could not pass from one module to another.
MANYLINUX_LIBRARIES = GLIBC_LIBRARIES | {"libstdc++.so.6", "libgcc_s.so.1", "libatomic.so.1", "libz.so.1"}

# For each manylinux tag (its glibc version): the highest versions of symbols, from the policies of auditwheel for
# x86_64. The C++ libraries of Debian 12 and 13 need at least glibc 2.34.
_LIMITS: dict[Version, dict[str, Version]] = {
    (2, 34): {"GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (7, 0, 0), "ZLIB": (1, 2, 9)},
    (2, 35): {"GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12, 0, 0), "ZLIB": (1, 2, 9)},
    (2, 39): {"GLIBCXX": (3, 4, 33), "CXXABI": (1, 3, 15), "GCC": (14, 0, 0), "ZLIB": (1, 2, 12)},
}
_GLIBC_OF_NAMES = {"ABI_DT_RELR": (2, 36)}  # GLIBC_ABI_DT_RELR is for compact relocations.


class NotPortable(Exception):
    """The library is not portable; the text has the reason."""


class Elf(NamedTuple):
    """The dynamic section of a library."""

    needed: tuple[str, ...]
    run_path: str
    versions: dict[str, Version]  # For each name (GLIBC, GLIBCXX, ...): the highest version that the library needs.

    @classmethod
    def read(cls, path: pathlib.Path) -> Elf:
        command = ["objdump", "-p", str(path)]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        needed = tuple(re.findall(r"^  NEEDED +(\S+)$", text, re.MULTILINE))
        run_paths = re.findall(r"^  (?:RUNPATH|RPATH) +(\S+)$", text, re.MULTILINE)
        versions: dict[str, Version] = {}
        for name, number in re.findall(r"^    0x\w+ 0x\w+ \d+ ([A-Z]+)_(\S+)$", text, re.MULTILINE):
            if name in ("GLIBC", "GLIBCXX", "CXXABI", "GCC", "ZLIB"):
                versions[name] = max(versions.get(name, (0,)), _version(number, f"{path.name}: {name}"))
        return cls(needed, ":".join(run_paths), versions)


def _version(number: str, what: str) -> Version:
    if number in _GLIBC_OF_NAMES:
        return _GLIBC_OF_NAMES[number]
    if not re.fullmatch(r"[0-9.]+", number):
        raise NotPortable(f"{what}_{number} is no version of a manylinux policy")
    return tuple(int(part) for part in number.split("."))


def dotted(version: Version) -> str:
    return ".".join(str(part) for part in version)


def highest(libraries: Iterable[Elf]) -> dict[str, Version]:
    versions: dict[str, Version] = {}
    for library in libraries:
        for name, version in library.versions.items():
            versions[name] = max(versions.get(name, (0,)), version)
    return versions


def least_glibc(versions: dict[str, Version]) -> Version:
    """Returns the glibc version of the lowest manylinux tag that allows these symbol versions."""
    others = {name: version for name, version in versions.items() if name != "GLIBC"}
    for glibc, limits in _LIMITS.items():
        if all(version <= limits[name] for name, version in others.items()):
            return max(glibc, versions["GLIBC"][:2])
    raise NotPortable(f"no manylinux policy allows {', '.join(f'{n}_{dotted(v)}' for n, v in others.items())}")

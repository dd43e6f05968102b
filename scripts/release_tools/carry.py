"""Copies libraries into a package: libraries that its binaries need and that some systems do not have."""

from __future__ import annotations

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
from collections.abc import Collection, Sequence

from elf import Elf, NotPortable

# Libraries that keep their names, because another library opens them by name at run time, in its own folder.
_OPENED = {"libtbb.so.12": ("libtbbmalloc.so.2",)}


def _libraries_of(binary: pathlib.Path) -> dict[str, pathlib.Path]:
    """Returns the files of all libraries that the dynamic linker loads with a binary. Keys are names of libraries."""
    output = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
    if missing := re.findall(r"^\s*(\S+) => not found", output, re.MULTILINE):
        raise NotPortable(f"not found: {', '.join(missing)}")
    return {name: pathlib.Path(path) for name, path in re.findall(r"(\S+) => (\S+) \(", output)}


def _new_name(name: str, file: pathlib.Path) -> str:
    """Returns a name with a hash (libtbb-0123abcd.so.12), so that another libtbb.so.12 in a process is not used."""
    digest = hashlib.sha256(file.read_bytes()).hexdigest()[:8]
    stem, dot, rest = name.partition(".so")
    return f"{stem}-{digest}{dot}{rest}"


def _patch(file: pathlib.Path, new_names: dict[str, str], *other: tuple[str, str]) -> None:
    needed = [name for name in Elf.read(file).needed if name in new_names]
    for change in (*(("--replace-needed", name, new_names[name]) for name in needed), *other):
        # One change per run, because patchelf 0.14 makes errors with several changes in one run.
        subprocess.run(["patchelf", *change, file], check=True)


def _run_path(binary: pathlib.Path, folder: pathlib.Path) -> str:
    return f"$ORIGIN/{os.path.relpath(folder, binary.parent)}"


def carry(binaries: Sequence[pathlib.Path], folder: pathlib.Path,
          system: Collection[str]) -> dict[str, pathlib.Path]:  # fmt: skip
    """Copies the libraries of the binaries into a new folder, except libraries of the system.

    Strips the binaries, and sets the run paths relative to $ORIGIN, so that binaries and libraries find each other.
    Returns the original file of each copy. Keys are the new names.
    """
    sources = {name: file for binary in binaries for name, file in _libraries_of(binary).items() if name not in system}
    new_names = {name: _new_name(name, file) for name, file in sources.items()}
    for name, opened in _OPENED.items():
        if name in new_names:
            sources |= {other: sources[name].with_name(other) for other in opened}
    folder.mkdir()
    carried = {}
    for name, source in sources.items():
        new_name = new_names.get(name, name)
        file = folder / new_name
        shutil.copyfile(source, file)
        _patch(file, new_names, ("--set-soname", new_name), ("--set-rpath", "$ORIGIN"))
        carried[new_name] = source
    for binary in binaries:
        # strip must run before patchelf, because patchelf moves sections.
        subprocess.run(["strip", "--strip-unneeded", binary], check=True)
        _patch(binary, new_names, ("--set-rpath", _run_path(binary, folder)))
    return carried


def check(binaries: Sequence[pathlib.Path], folder: pathlib.Path, system: Collection[str]) -> dict[pathlib.Path, Elf]:
    """Returns the binaries and their libraries. Fails if one of these files needs a library that is neither in the
    folder nor a library of the system."""
    libraries = {file: Elf.read(file) for file in (*binaries, *sorted(folder.iterdir()))}
    for file, library in libraries.items():
        if outside := set(library.needed) - {other.name for other in libraries} - set(system):
            raise NotPortable(f"{file.name} needs {', '.join(sorted(outside))}")
        expected = _run_path(file, folder) if file in binaries else "$ORIGIN"
        if library.run_path != expected:
            raise NotPortable(f"{file.name} has the run path '{library.run_path}', not '{expected}'")
    return libraries


def describe(libraries: dict[pathlib.Path, Elf]) -> list[str]:
    """Returns a line per file, with its size and the names of the libraries that it needs."""
    return [f"  {file.name}, {file.stat().st_size:,} bytes, needs {' '.join(library.needed)}"
            for file, library in libraries.items()]  # fmt: skip

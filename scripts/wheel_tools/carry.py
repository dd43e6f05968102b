"""Copies libraries into a package: libraries that its module needs and that some systems do not have."""

from __future__ import annotations

import hashlib
import pathlib
import re
import shutil
import subprocess

from elf import SYSTEM_LIBRARIES, Elf, NotPortable

FOLDER = "libs"  # Folder of the libraries in the package.

# Libraries that keep their names, because another library opens them by name at run time, in its own folder.
_OPENED = {"libtbb.so.12": ("libtbbmalloc.so.2",)}


def _libraries_of(module: pathlib.Path) -> dict[str, pathlib.Path]:
    """Returns the files of all libraries that the dynamic linker loads with a module. Keys are names of libraries."""
    output = subprocess.run(["ldd", module], check=True, capture_output=True, text=True).stdout
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


def carry(module: pathlib.Path) -> dict[str, pathlib.Path]:
    """Copies the libraries, and sets the run paths to $ORIGIN, so that module and libraries find each other.

    Returns the original file of each copy. Keys are the new names.
    """
    sources = {name: file for name, file in _libraries_of(module).items() if name not in SYSTEM_LIBRARIES}
    new_names = {name: _new_name(name, file) for name, file in sources.items()}
    for name, opened in _OPENED.items():
        if name in new_names:
            sources |= {other: sources[name].with_name(other) for other in opened}
    folder = module.parent / FOLDER
    folder.mkdir()
    carried = {}
    for name, source in sources.items():
        new_name = new_names.get(name, name)
        file = folder / new_name
        shutil.copyfile(source, file)
        _patch(file, new_names, ("--set-soname", new_name), ("--set-rpath", "$ORIGIN"))
        carried[new_name] = source
    # strip must run before patchelf, because patchelf moves sections.
    subprocess.run(["strip", "--strip-unneeded", module], check=True)
    _patch(module, new_names, ("--set-rpath", f"$ORIGIN/{FOLDER}"))
    return carried


def check(module: pathlib.Path) -> dict[pathlib.Path, Elf]:
    """Returns the module and its libraries. Fails if one of these files needs a library that is not on every system."""
    files = [module, *sorted((module.parent / FOLDER).iterdir())]
    libraries = {file: Elf.read(file) for file in files}
    for file, library in libraries.items():
        if outside := set(library.needed) - {other.name for other in files} - SYSTEM_LIBRARIES:
            raise NotPortable(f"{file.name} needs {', '.join(sorted(outside))}")
        expected = f"$ORIGIN/{FOLDER}" if file == module else "$ORIGIN"
        if library.run_path != expected:
            raise NotPortable(f"{file.name} has the run path '{library.run_path}', not '{expected}'")
    return libraries

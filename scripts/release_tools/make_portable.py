"""Makes the portable folder: programs with the libraries that they need, except glibc; scripts/release calls it."""

from __future__ import annotations

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

from carry import carry, check, describe
from elf import GLIBC_LIBRARIES, NotPortable, dotted, highest
from licences import add_licences

_SOURCE = pathlib.Path(__file__).resolve().parents[2]
_PROGRAMS = ("asdf-vk", "asdf-vk-generate")
# Packages whose headers are compiled into the programs.
_HEADER_PACKAGES = ("libcli11-dev", "libeigen3-dev", "libvulkan-dev", "libvulkan-volk-dev", "nlohmann-json3-dev")


def _say(text: str) -> None:
    print(f"portable: {text}", file=sys.stderr, flush=True)


def _fill(folder: pathlib.Path, programs: pathlib.Path, limit: str) -> None:
    """Copies programs, libraries and licences into the folder. `limit`: the highest allowed version of glibc."""
    (folder / "bin").mkdir(parents=True)
    binaries = [folder / "bin" / name for name in _PROGRAMS]
    for binary in binaries:
        shutil.copy(programs / binary.name, binary)
    carried = carry(binaries, folder / "lib", GLIBC_LIBRARIES)
    add_licences(folder / "licences", carried, _HEADER_PACKAGES)
    shutil.copy(_SOURCE / "LICENSE", folder)
    libraries = check(binaries, folder / "lib", GLIBC_LIBRARIES)
    for line in describe(libraries):
        _say(line)
    glibc = highest(libraries.values())["GLIBC"]
    _say(f"  needs glibc {dotted(glibc)}")
    if glibc > tuple(int(part) for part in limit.split(".")):
        raise NotPortable(f"glibc {dotted(glibc)} is needed, and {limit} is the limit; build on an older system")


def _archive(folder: pathlib.Path, file: pathlib.Path) -> None:
    """Writes a .tar.gz whose bytes depend only on the content of the folder."""
    order = ["--sort=name", "--owner=root:0", "--group=root:0", "--mode=u=rwX,go=rX", "--mtime=@0"]
    command = ["tar", "--create", f"--file={file}", "--use-compress-program=gzip -9n", *order]
    subprocess.run([*command, f"--directory={folder.parent}", folder.name], check=True)


def main() -> int:
    parser = argparse.ArgumentParser(prog="make_portable.py", description=__doc__)
    parser.add_argument("programs", type=pathlib.Path, help="folder of the built programs")
    parser.add_argument("folder", type=pathlib.Path, help="folder of the archive; older archives in it are removed")
    parser.add_argument("--glibc", metavar="VERSION", default="2.36", help="the highest allowed version (default 2.36)")
    arguments = parser.parse_args()
    folder: pathlib.Path = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    command = [arguments.programs / "asdf-vk", "--version"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    machine = subprocess.run(["uname", "-m"], check=True, capture_output=True, text=True).stdout.strip()
    name = f"asdf-vk-{output.split()[1]}-linux-{machine}"
    with tempfile.TemporaryDirectory(dir=folder) as work:
        try:
            _fill(pathlib.Path(work) / name, arguments.programs, arguments.glibc)
        except (subprocess.CalledProcessError, NotPortable) as error:
            _say(f"the folder would not run on other systems: {error}")
            return 1
        for old in folder.glob("asdf-vk-*-linux-*.tar.gz"):
            old.unlink()
        archive = folder / f"{name}.tar.gz"
        _archive(pathlib.Path(work) / name, archive)
    _say(f"{archive}, {archive.stat().st_size:,} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())

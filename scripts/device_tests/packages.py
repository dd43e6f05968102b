"""Downloads and unpacks packages of the configured package sources without installing them."""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import time
from typing import NamedTuple

_LISTS_MAX_AGE_SECONDS = 24 * 3600


class Unavailable(Exception):
    """A package cannot be downloaded; the text has the reason."""


class Candidate(NamedTuple):
    version: str
    suite: str  # Name of the release or suite, for example bookworm-backports.


def _run(*command: str | pathlib.Path, cwd: pathlib.Path | None = None) -> str:
    try:
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=True)
    except FileNotFoundError as error:
        raise Unavailable(f"there is no {command[0]}") from error
    except subprocess.CalledProcessError as error:
        lines = (error.stderr or error.stdout).strip().splitlines()
        raise Unavailable(f"{command[0]} failed: {lines[-1] if lines else ''}") from error
    return done.stdout


def is_newer(version: str, other: str) -> bool:
    done = subprocess.run(["dpkg", "--compare-versions", version, "gt", other], check=False)
    return done.returncode == 0


class PackageSources:
    """The package sources of this machine. Lists and downloads are below `folder`."""

    def __init__(self, folder: pathlib.Path) -> None:
        self._lists = folder / "lists"
        self._archives = folder / "archives"
        (self._lists / "partial").mkdir(parents=True, exist_ok=True)
        self._archives.mkdir(exist_ok=True)
        settings = {
            "Dir::State::lists": self._lists,
            "Dir::Cache": folder,
            "APT::Sandbox::User": "root",
        }
        self._options = [f"-o{name}={value}" for name, value in settings.items()]
        stamp = folder / "updated"
        if stamp.exists() and time.time() - stamp.stat().st_mtime < _LISTS_MAX_AGE_SECONDS:
            return
        try:
            _run("apt-get", *self._options, "-qq", "update")
            stamp.touch()
        except Unavailable:
            if not stamp.exists():
                raise

    def newest(self, package: str) -> Candidate:
        """Returns the newest version in the sources. Ignores pinning."""
        best: Candidate | None = None
        for line in _run("apt-cache", *self._options, "madison", package).splitlines():
            _, version, origin = (part.strip() for part in line.split("|"))
            suite = origin.split()[1].split("/")[0]
            if not origin.endswith(" Sources") and (not best or is_newer(version, best.version)):
                best = Candidate(version, suite)
        if best is None:
            raise Unavailable(f"the package sources have no {package}")
        return best

    def installed_version(self, package: str) -> str:
        """Returns the installed version, or "" if the package is not installed."""
        for line in _run("apt-cache", *self._options, "policy", package).splitlines():
            if line.strip().startswith("Installed:") and "(none)" not in line:
                return line.split()[1]
        return ""

    def required(self, package: str, candidate: Candidate) -> dict[str, str]:
        """Returns the versions of the packages that an installation would add or replace."""
        command = ["apt-get", *self._options, "install", "--simulate", "--no-install-recommends"]
        command.append(f"--target-release={candidate.suite}")
        output = _run(*command, f"{package}={candidate.version}")
        versions = {}
        for line in output.splitlines():
            if line.startswith("Inst "):
                versions[line.split()[1]] = line[line.index("(") + 1 :].split()[0]
        return versions

    def download(self, package: str, version: str) -> pathlib.Path:
        name = f"{package}_{version.replace(':', '%3a')}_*.deb"
        if not list(self._archives.glob(name)):
            command = ["apt-get", *self._options, "-qq", "download", f"{package}={version}"]
            _run(*command, cwd=self._archives)
        return next(self._archives.glob(name))


    def unpack(self, versions: dict[str, str], folder: pathlib.Path) -> None:
        if folder.exists():
            return
        partial = folder.parent / "unpacking"
        shutil.rmtree(partial, ignore_errors=True)
        for package, version in versions.items():
            _run("dpkg-deb", "--extract", self.download(package, version), partial)
        partial.rename(folder)

"""Tests scripts/install-packages with made-up os-release files, compilers and package managers."""

from __future__ import annotations

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "install-packages"
FEDORA = 'ID=fedora\nPRETTY_NAME="Fedora Linux 40"\n'
UBUNTU = "ID=ubuntu\nID_LIKE=debian\nVERSION_CODENAME=noble\n"
MINT = 'ID=linuxmint\nID_LIKE="ubuntu debian"\nVERSION_CODENAME=wilma\n'
TOOLS = "bash sh awk sort head cat grep id env mktemp rm".split()


class InstallPackagesTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.tools = self.folder / "bin"
        self.tools.mkdir()
        for name in TOOLS:
            for parent in ("/usr/bin", "/bin"):
                if (Path(parent) / name).exists():
                    (self.tools / name).symlink_to(Path(parent) / name)
                    break

    def tool(self, name: str, script: str = "exit 0") -> None:
        path = self.tools / name
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)

    def build_tools(self, cmake: str = "3.28.3", compiler: str = "exit 0") -> None:
        self.tool("cmake", f"echo cmake version {cmake}")
        self.tool("ninja")
        self.tool("glslangValidator")
        self.tool("c++", compiler)

    def debian_tools(self) -> None:
        """dpkg-query finds nothing; apt-get writes its arguments to a file."""
        self.tool("dpkg-query", "exit 1")
        self.tool("apt-get", f'echo "$@" >>{self.folder}/apt.log')
        self.tool("sudo", 'exec "$@"')

    def run_on(self, system: str) -> subprocess.CompletedProcess[str]:
        release = self.folder / "os-release"
        release.write_text(system)
        environment = {"PATH": str(self.tools), "ASDF_VK_OS_RELEASE": str(release), "HOME": os.environ.get("HOME", "/")}
        return subprocess.run([str(SCRIPT)], env=environment, capture_output=True, text=True, check=False)

    def test_an_unknown_system_without_tools_is_an_error_that_names_all(self) -> None:
        result = self.run_on(FEDORA)
        self.assertEqual(result.returncode, 1)
        for text in ("Fedora Linux 40 is not Debian", "CMake 3.25 or later (found: none)", "ninja", "glslangValidator",
                     "a compiler of C++20"):
            self.assertIn(text, result.stderr)

    def test_an_unknown_system_with_all_tools_goes_on(self) -> None:
        self.build_tools()
        result = self.run_on(FEDORA)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_an_old_cmake_is_missing(self) -> None:
        self.build_tools(cmake="3.22.1")
        result = self.run_on(FEDORA)
        self.assertEqual(result.returncode, 1)
        self.assertIn("CMake 3.25 or later (found: 3.22.1)", result.stderr)

    def run_without_header(self, header: str) -> str:
        """Returns the messages on a system whose compiler does not find the header."""
        self.build_tools(compiler=f"! grep -q {header}")
        result = self.run_on(FEDORA)
        self.assertEqual(result.returncode, 1)
        return result.stderr

    def test_a_compiler_without_stop_token_is_missing(self) -> None:
        messages = self.run_without_header("stop_token")
        self.assertIn("<stop_token>", messages)
        self.assertNotIn("<png.h>", messages)

    def test_a_library_is_missing(self) -> None:
        self.assertIn("the library with <png.h>", self.run_without_header("png.h"))

    def test_relatives_of_debian_install_its_packages(self) -> None:
        self.debian_tools()
        for system in (UBUNTU, MINT, "ID=debian\nVERSION_CODENAME=trixie\n"):
            log = self.folder / "apt.log"
            log.unlink(missing_ok=True)
            result = self.run_on(system)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("libvulkan-volk-dev", log.read_text())

    def test_apt_on_an_unknown_system_is_not_used(self) -> None:
        self.debian_tools()
        result = self.run_on(FEDORA)
        self.assertEqual(result.returncode, 1)
        self.assertFalse((self.folder / "apt.log").exists())


if __name__ == "__main__":
    unittest.main()

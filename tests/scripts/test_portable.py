"""Makes the portable folder with the programs of the build, and tests it by scripts/test-portable."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
PROGRAMS = Path(os.environ["ASDF_VK_PROGRAM"]).parent


def run(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False)


def make(folder: str, glibc: str) -> subprocess.CompletedProcess[str]:
    script = SCRIPTS / "release_tools" / "make_portable.py"
    return run(sys.executable, "-B", script, "--glibc", glibc, PROGRAMS, folder)


@unittest.skipUnless(shutil.which("patchelf") and shutil.which("dpkg-query"), "needs patchelf, and packages of Debian")
class PortableTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_the_folder_runs_on_a_system_with_only_glibc(self) -> None:
        made = make(self.folder, "99")
        self.assertEqual(made.returncode, 0, made.stderr)
        archives = list(Path(self.folder).iterdir())
        self.assertEqual(len(archives), 1, archives)
        tested = run(SCRIPTS / "test-portable", archives[0])
        if tested.returncode != 0 and os.getuid() != 0 and run("unshare", "--map-root-user", "true").returncode != 0:
            self.skipTest("needs root or user namespaces")
        self.assertEqual(tested.returncode, 0, tested.stderr)

    def test_a_newer_glibc_than_the_limit_is_an_error(self) -> None:
        made = make(self.folder, "2.2")
        self.assertEqual(made.returncode, 1)
        self.assertIn("and 2.2 is the limit", made.stderr)
        self.assertEqual(list(Path(self.folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main()

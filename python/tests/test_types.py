"""Checks the type annotations of the package and of these tests, and their effect in the code of a caller."""

from __future__ import annotations

import inspect
import os
import re
import site
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asdf_vk
from asdf_vk import _core

_ROOT = Path(__file__).resolve().parents[2]
_PACKAGE = Path(asdf_vk.__file__).parent  # The package of the build, which has the classes that the build writes.


def mypy(*arguments: str, folder: Path = _ROOT) -> str:
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--config-file", str(_ROOT / "pyproject.toml"), *arguments]
    # The stubs of NumPy 2.1 need Python 3.10. With Python 3.9, the type of every array would be Any.
    if np.lib.NumpyVersion(np.__version__) >= "2.1.0":
        command += ["--python-version", "3.10"]
    # mypy finds installed packages without MYPYPATH, and refuses their folder in MYPYPATH.
    installed = str(_PACKAGE.parent) in site.getsitepackages()
    environment = dict(os.environ) if installed else {**os.environ, "MYPYPATH": str(_PACKAGE.parent)}
    finished = subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment)
    return finished.stdout + finished.stderr


def test_the_package_and_its_tests_are_typed() -> None:
    found = mypy(
        "--cache-dir=/dev/null", str(_PACKAGE), "python/tests", "python/cgal_Segmentation_Module.py"
    )
    # mypy 1.15 prints a warning before this line: the option for Unpack, which mypy 1.0 needs, is no longer needed.
    assert re.search(r"^Success", found, re.MULTILINE), found


def test_a_caller_sees_types(tmp_path: Path) -> None:
    (tmp_path / "caller.py").write_text(
        "import asdf_vk\n"
        "import numpy as np\n"
        "v, f = np.zeros((3, 3)), np.zeros((1, 3), int)\n"
        "reveal_type(asdf_vk.shape_diameter(v, f))\n"
        "reveal_type(asdf_vk.compute(v, f, segment='parts').segment_count)\n"
        "asdf_vk.shape_diameter(v, f, rays='many')\n"
        "reveal_type(asdf_vk.radii(v, f, v, threads=1))\n"
    )
    found = mypy("--cache-dir=/dev/null", "caller.py", folder=tmp_path)
    assert re.search(r"numpy\.floating\[numpy\._typing\.(_nbit_base\.)?_32Bit\]", found), found
    assert "Union[builtins.int, None]" in found, found
    as_64_bits = r"numpy\.(float64|floating\[numpy\._typing\.(_nbit_base\.)?_64Bit\])"
    assert re.search(r"caller.py:7: note: .*" + as_64_bits, found), found
    assert re.search(r'caller.py:6: error: Argument "rays"', found) and "Found 1 error" in found, found


def test_stubs_name_what_the_extension_has() -> None:
    stub = (Path(asdf_vk.__file__).parent / "_core.pyi").read_text()
    assert set(re.findall(r"^    def (\w+)", stub, re.MULTILINE)) <= set(dir(_core.Mesh))
    assert hasattr(_core, "version") and hasattr(_core, "commit")


def test_everything_public_has_a_docstring() -> None:
    for name in asdf_vk.__all__:
        item = getattr(asdf_vk, name)
        if callable(item):
            assert inspect.getdoc(item), name

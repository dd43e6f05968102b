"""Runs the examples of the manual, and compares their output."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asdf_vk
from ply import fields_of_ply
from shapes import cube, dumbbell

_ROOT = Path(__file__).resolve().parents[2]


def test_parts_and_thickness(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    asdf_vk.write(tmp_path / "dumbbell.ply", dumbbell())
    script = _ROOT / "docs/examples/parts_and_thickness.py"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    finished = subprocess.run(
        [sys.executable, script, tmp_path / "dumbbell.ply", tmp_path],
        env=environment, capture_output=True, text=True,
    )  # fmt: skip
    assert finished.returncode == 0, finished.stderr
    count = re.search(r"^(\d+) parts$", finished.stdout, re.MULTILINE)
    assert count is not None and int(count.group(1)) >= 2
    assert (tmp_path / "parts.png").read_bytes().startswith(b"\x89PNG")
    fields, _ = fields_of_ply(tmp_path / "parts.ply")
    np.testing.assert_array_equal(fields["part"], asdf_vk.segment(*dumbbell()))


def test_the_class_of_the_ray_recipe(tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location("ray_batch", _ROOT / "docs/examples/cluster/ray_batch.py")
    assert spec is not None and spec.loader is not None
    recipe = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(recipe)
    vertices, faces = cube()
    for name, height in {"thick": 1, "thin": 0.1}.items():
        asdf_vk.write(tmp_path / f"{name}.ply", (vertices * [1, 1, height], faces))
    contents = [(tmp_path / f"{name}.ply").read_bytes() for name in ("thick", "thin")]
    batch = {"path": np.array(["a", "b", "c"]), "bytes": np.array([*contents, b"nonsense"], dtype=object)}
    table = recipe.Check(thinner_than=0.5)(batch)
    assert list(table["path"]) == ["a", "b", "c"]
    assert list(table["verdict"]) == ["passed", "failed", ""]
    least = 0.1 * np.ptp(vertices[:, 2])
    assert table["least"][1] == pytest.approx(least, rel=1e-3)
    assert list(table["faces"]) == [len(faces), len(faces), 0]
    assert [bool(error) for error in table["error"]] == [False, False, True]


def test_thin_walls(tmp_path: Path, program: Path) -> None:
    vertices, faces = cube()
    asdf_vk.write(tmp_path / "thick.ply", (vertices, faces))
    asdf_vk.write(tmp_path / "thin.ply", (vertices * [1, 1, 0.1], faces))
    environment = {**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}"}
    finished = subprocess.run(
        [_ROOT / "docs/examples/thin_walls.sh", "0.5", tmp_path / "thick.ply", tmp_path / "thin.ply"],
        env=environment, capture_output=True, text=True,
    )  # fmt: skip
    assert finished.returncode == 6, finished.stderr
    thick, thin = finished.stdout.splitlines()
    assert thick.endswith("thick.ply: 0 faces thinner than 0.5")
    assert re.search(r"thin.ply: [1-9]\d* faces thinner than 0.5$", thin)


def test_the_client_of_the_server(tmp_path: Path, program: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asdf_vk.write(tmp_path / "cube.ply", cube())
    monkeypatch.setenv("PATH", f"{program.parent}{os.pathsep}{os.environ['PATH']}")
    (block,) = re.findall(r"```python\n(.*?)```", (_ROOT / "docs/serve.md").read_text(), re.DOTALL)
    names: dict[str, Any] = {}
    exec(block, names)
    with names["server"] as server:
        assert names["check"](str(tmp_path / "cube.ply"), 1e-3)["verdict"] == "passed"
        assert names["check"](str(tmp_path / "cube.ply"), 1e3)["verdict"] == "failed"
        with pytest.raises(RuntimeError, match="cannot be opened"):
            names["check"](str(tmp_path / "missing.ply"), 1)
        server.stdin.close()
    assert server.returncode == 0


@pytest.mark.parametrize("page", ["README.md", "docs/python.md", "docs/cgal.md"])
def test_the_python_of_the_pages(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    vertices, faces = dumbbell()
    (tmp_path / "neuron.off").write_text(
        "\n".join(["OFF", f"{len(vertices)} {len(faces)} 0", *(f"{x} {y} {z}" for x, y, z in vertices),
                   *(f"3 {a} {b} {c}" for a, b, c in faces)])
    )  # fmt: skip
    monkeypatch.chdir(tmp_path)
    mesh = asdf_vk.read_mesh("neuron.off")
    points, normals = np.array([[0.0, 0, 0]]), np.array([[0.0, 0, 1]])
    names: dict[str, Any] = {"asdf_vk": asdf_vk, "vertices": vertices, "faces": faces, "mesh": mesh}
    blocks = re.findall(r"```python\n(.*?)```", (_ROOT / page).read_text(), re.DOTALL)
    assert blocks
    for block in blocks:
        names.update(points=points, normals=normals, n=normals, mask=np.arange(len(faces)) < 100)
        exec(block, names)
    if "record_of" in names:
        assert names["record_of"]("neuron.off")["median"] > 0
        assert names["record_of"]("missing.off")["code"]
    assert names["code"] == 1 if page.endswith("cgal.md") else isinstance(names["values"], np.ndarray)

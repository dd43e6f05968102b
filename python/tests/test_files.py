"""Reading and writing."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

import asdf_vk
from shapes import cube, sphere


def test_a_mesh_survives_a_file(tmp_path: Path) -> None:
    vertices, faces = sphere(2)
    for name in ("mesh.ply", "text.ply"):
        asdf_vk.write(tmp_path / name, (vertices, faces), ascii=name != "mesh.ply")
        mesh = asdf_vk.read_mesh(tmp_path / name)
        np.testing.assert_array_equal(mesh.vertices, vertices)
        np.testing.assert_array_equal(mesh.faces, faces)
        assert mesh.face_count == len(faces) and mesh.face_of_triangle is None
        assert not mesh.vertices.flags.writeable


@pytest.mark.parametrize("name", ["result.ply", "result.vtu", "result.npz"])
def test_fields_survive_a_file(tmp_path: Path, name: str) -> None:
    vertices, faces = sphere(3)
    info = asdf_vk.segment(vertices, faces, return_info=True)[1]
    own = {"area": np.arange(len(faces)), "flag": np.arange(len(faces)) % 2 == 0}
    per_vertex = {"height": vertices[:, 2].astype(np.float32)}
    asdf_vk.write(tmp_path / name, (vertices, faces), {**info.fields, **own}, vertex_fields=per_vertex)
    fields, vertex_fields = asdf_vk.read_fields(tmp_path / name)
    np.testing.assert_array_equal(fields["segment"], info.fields["segment"])
    np.testing.assert_array_equal(fields["area"], own["area"])
    np.testing.assert_array_equal(fields["flag"], own["flag"])
    np.testing.assert_array_equal(fields["sdf" if "sdf" in fields else "quality"], info.fields["sdf"])
    heights = {**fields, **{f"vertex_{key}": value for key, value in vertex_fields.items()}}
    height = heights["vertex_height" if "vertex_height" in heights else "vertex_quality"]
    np.testing.assert_array_equal(height, per_vertex["height"])


def test_polygons_have_a_value_each(tmp_path: Path) -> None:
    path = tmp_path / "cube.off"
    quads = "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n"
    path.write_text("OFF\n8 6 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in cube()[0]) + quads)
    mesh = asdf_vk.read_mesh(path)
    assert mesh.faces.shape == (12, 3) and mesh.face_count == 6
    assert mesh.face_of_triangle is not None
    np.testing.assert_array_equal(mesh.face_of_triangle, np.repeat(np.arange(6), 2))
    values = asdf_vk.shape_diameter(mesh, seeds="all")
    assert values.shape == (6,)
    asdf_vk.write(tmp_path / "quads.ply", mesh, {"sdf": values})
    assert asdf_vk.read_mesh(tmp_path / "quads.ply").face_count == 6


def test_a_mesh_can_be_pickled(tmp_path: Path) -> None:
    path = tmp_path / "quads.off"
    path.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n4 3 2 1 0\n")
    mesh = asdf_vk.read_mesh(path)
    copies = pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)
    for other in copies:
        np.testing.assert_array_equal(other.vertices, mesh.vertices)
        np.testing.assert_array_equal(other.faces, mesh.faces)
        assert other.face_count == 2 and repr(other) == repr(mesh) == "<asdf_vk.Mesh, 4 vertices, 2 faces>"


def test_failures_leave_nothing_behind(tmp_path: Path) -> None:
    mesh = cube()
    with pytest.raises(asdf_vk.OutputError) as caught:
        asdf_vk.write(tmp_path / "missing" / "x.ply", mesh)
    assert caught.value.code == "outputNotWritable" and "missing" in str(caught.value)
    with pytest.raises(asdf_vk.UsageError):
        asdf_vk.write(tmp_path / "x.unknown", mesh)
    with pytest.raises(asdf_vk.UsageError):
        asdf_vk.write(tmp_path / "x.ply", mesh, {"sdf": np.zeros(5)})
    with pytest.raises(asdf_vk.InputError) as unreadable:
        asdf_vk.read_mesh(tmp_path / "none.ply")
    assert unreadable.value.code == "unreadableInput"
    assert list(tmp_path.iterdir()) == []

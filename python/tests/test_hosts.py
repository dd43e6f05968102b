"""Tests parts of the add-ons without Blender, FreeCAD or ParaView. scripts/test-hosts tests them in these programs."""

from __future__ import annotations

import ast
import importlib.util
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

import asdf_vk
import asdf_vk.hosts
from asdf_vk.compat import vtk
from shapes import cube


def test_the_package_has_the_add_ons() -> None:
    printed = subprocess.run([sys.executable, "-m", "asdf_vk.hosts"], capture_output=True, text=True, check=True).stdout
    paths = [Path(line) for line in printed.splitlines()]
    assert [path.name for path in paths] == [f"asdf_vk_{host}.py" for host in ("blender", "freecad", "paraview")]
    for path in paths:
        documentation = ast.get_docstring(ast.parse(path.read_text()))
        assert documentation and path.parent == Path(next(iter(asdf_vk.hosts.__path__)))
    version = tuple(map(int, asdf_vk.__version__.split(".")))
    assert f'"version": {version},' in paths[0].read_text()  # Blender parses this line.


def _surface(with_line: bool) -> Any:
    """A unit cube as vtkPolyData."""
    core, data = pytest.importorskip("vtkmodules.vtkCommonCore"), pytest.importorskip("vtkmodules.vtkCommonDataModel")
    vertices, faces = cube()
    points, cells, lines = core.vtkPoints(), data.vtkCellArray(), data.vtkCellArray()
    for vertex in vertices:
        points.InsertNextPoint(vertex)
    for face in faces:
        cells.InsertNextCell(3, face.tolist())
    surface = data.vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    if with_line:
        lines.InsertNextCell(2, [0, 7])
        surface.SetLines(lines)
    return surface


class _Items(list):  # type: ignore[type-arg]
    """A collection of Blender with one property."""

    def foreach_get(self, name: str, values: Any) -> None:
        values[:] = np.ravel([getattr(item, name) for item in self])

    def foreach_set(self, name: str, values: Any) -> None:
        for item, value in zip(self, values):
            setattr(item, name, value)


class _Attributes(dict):  # type: ignore[type-arg]
    def new(self, name: str, kind: str, domain: str) -> Any:
        self[name] = SimpleNamespace(name=name, domain=domain, data=_Items(SimpleNamespace(value=0) for _ in range(12)))
        return self[name]

    def remove(self, attribute: Any) -> None:
        del self[attribute.name]

    def __iter__(self) -> Any:
        return iter(self.values())

    def __contains__(self, name: object) -> bool:
        return name in self.keys()


class _Materials(list):  # type: ignore[type-arg]
    def pop(self, index: int) -> Any:  # type: ignore[override]
        return list.pop(self, index)


@pytest.fixture
def blender(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The add-on, imported with a substitute for Blender."""
    bpy, props = ModuleType("bpy"), ModuleType("bpy.props")
    for name in ("Bool", "Enum", "Float", "Int", "Pointer", "String"):
        setattr(props, f"{name}Property", lambda **_: None)
    bpy.types = SimpleNamespace(  # type: ignore[attr-defined]
        **{name: type(name, (), {}) for name in ("Operator", "PropertyGroup", "Panel", "AddonPreferences")})
    tree = SimpleNamespace(nodes=[])
    bpy.data = SimpleNamespace(materials=SimpleNamespace(  # type: ignore[attr-defined]
        get=lambda _: None, new=lambda name: SimpleNamespace(name=name, node_tree=tree)))
    monkeypatch.setitem(sys.modules, "bpy", bpy)
    monkeypatch.setitem(sys.modules, "bpy.props", props)
    path = Path(next(iter(asdf_vk.hosts.__path__))) / "asdf_vk_blender.py"
    specification = importlib.util.spec_from_file_location("asdf_vk_blender", path)
    assert specification and specification.loader
    addon = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(addon)
    return addon


def _blender_object(matrix: Any, vertices: Any, faces: Any) -> Any:
    """An object of Blender with a mesh of triangles."""
    data = SimpleNamespace(
        vertices=_Items(SimpleNamespace(co=vertex) for vertex in vertices),
        loops=_Items(SimpleNamespace(vertex_index=index) for index in np.ravel(faces)),
        polygons=_Items(SimpleNamespace(loop_start=3 * i, material_index=i % 2) for i in range(len(faces))),
        attributes=_Attributes(), uv_layers=(), materials=_Materials())
    return SimpleNamespace(name="box", data=data, vertex_groups=(), matrix_world=matrix)


@pytest.mark.filterwarnings("ignore::asdf_vk.MeshWarning")
def test_blender_reverses_the_faces_of_mirrored_objects(blender: Any) -> None:
    vertices, faces = cube()
    for mirror in (1, -1):
        matrix = np.diag([mirror, 1, 1, 1])
        closed = blender.mesh_of(asdf_vk, _blender_object(matrix, vertices, faces))
        open_box = blender.mesh_of(asdf_vk, _blender_object(matrix, vertices, faces[:-1]))
        for mesh, verdict in ((closed, "passed"), (open_box, "notJudged")):
            report = asdf_vk.compute(mesh, thinner_than=0.5).thickness
            assert report is not None and report.verdict == verdict
    corners = blender.reversed_faces(np.arange(7), np.array([0, 3, 7]))
    np.testing.assert_array_equal(corners, [0, 2, 1, 3, 6, 5, 4])


def test_blender_keeps_the_materials_of_the_user(blender: Any) -> None:
    vertices, faces = cube()
    mesh = _blender_object(np.eye(4), vertices, faces).data
    own = [SimpleNamespace(name=f"own {i}") for i in range(2)]
    mesh.materials += own
    for count in (3, 2):
        blender.add_parts(mesh, np.arange(12) % count)
        assert [material.name for material in mesh.materials[2:]] == [f"asdf-vk part {i}" for i in range(count)]
        assert [polygon.material_index for polygon in mesh.polygons] == [2 + i % count for i in range(12)]
    mesh.polygons[3].material_index = 0  # The user changes it.
    blender.remove_parts(mesh)
    assert mesh.materials == own and not mesh.attributes.keys()
    assert [polygon.material_index for polygon in mesh.polygons] == [0, 1, 0, 0] + [0, 1] * 4


@pytest.mark.filterwarnings("ignore::asdf_vk.MeshWarning")
@pytest.mark.parametrize("with_line", [False, True])
def test_cell_arrays_of_vtk(with_line: bool) -> None:
    surface = _surface(with_line)
    values = vtk.thickness(surface, thinner_than=0.5)
    np.testing.assert_array_equal(values, asdf_vk.thickness(*cube()))
    from vtkmodules.util.numpy_support import vtk_to_numpy

    stored = vtk_to_numpy(surface.GetCellData().GetArray("least_thickness"))
    np.testing.assert_array_equal(stored, [np.nan] * with_line + [1] * 12)
    labels = vtk.segment(surface, parts=1)
    np.testing.assert_array_equal(labels, np.zeros(12))
    stored = vtk_to_numpy(surface.GetCellData().GetArray("segment"))
    np.testing.assert_array_equal(stored, [-1] * with_line + [0] * 12)
    assert vtk.shape_diameter(surface).shape == (12,)


def test_datasets_without_faces_are_refused() -> None:
    surface = _surface(True)  # The test is skipped if VTK is not installed.
    with pytest.raises(asdf_vk.ArrayTypeError, match="extract its surface"):
        vtk.compute(np.zeros((3, 3)))
    surface.SetPolys(type(surface.GetPolys())())
    with pytest.raises(asdf_vk.InputError, match="no faces"):
        vtk.segment(surface)

"""Tests parts of the add-ons without Blender, FreeCAD or ParaView. scripts/test-hosts tests them in these programs."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path
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

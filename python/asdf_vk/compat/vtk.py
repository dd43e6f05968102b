"""Cell arrays for surfaces of VTK, ParaView and PyVista.

    from asdf_vk.compat import vtk
    vtk.thickness(dataset, thinner_than=0.8)    # adds the cell array "thickness"

`dataset` is a vtkPolyData, for example a pyvista.PolyData. Each polygon has one value. Cells that are not faces
(vertices, lines) have the value NaN and the segment -1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._errors import error_of
from .._files import Mesh, mesh_of_polygons
from .._functions import compute as compute_mesh
from .._info import Info
from .._options import FunctionOptions

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["add_array", "compute", "mesh_of", "segment", "shape_diameter", "thickness"]


def mesh_of(dataset: Any) -> Mesh:
    """Returns the faces of a vtkPolyData, in their order. Raises InputError."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if not hasattr(dataset, "GetPolys"):
        raise error_of(
            "arrayType",
            f"{type(dataset).__name__} is no vtkPolyData: extract its surface first, in PyVista by extract_surface()",
        )
    if dataset.GetNumberOfStrips() > 0:
        raise error_of("arrayType", "the dataset has triangle strips: triangulate it first (vtkTriangleFilter)")
    faces = dataset.GetPolys()
    if faces.GetNumberOfCells() == 0 or dataset.GetNumberOfPoints() == 0:
        raise error_of("emptyMesh", "the dataset has no faces: extract its surface first")
    points = vtk_to_numpy(dataset.GetPoints().GetData())
    corners, first = (vtk_to_numpy(array) for array in (faces.GetConnectivityArray(), faces.GetOffsetsArray()))
    return mesh_of_polygons(points, corners, first)


def compute(dataset: Any, **options: Unpack[FunctionOptions]) -> Info:
    """Calls asdf_vk.compute() and adds a cell array for each field. Replaces cell arrays of the same names."""
    info = compute_mesh(mesh_of(dataset), **options)
    for name, values in info.fields.items():
        add_array(dataset, name, values)
    return info


def shape_diameter(dataset: Any, **options: Unpack[FunctionOptions]) -> NDArray[np.float32]:
    """Returns the shape diameter of each face. Adds the cell arrays "sdf" and "seed"."""
    return compute(dataset, **options).fields["sdf"]


def thickness(dataset: Any, **options: Unpack[FunctionOptions]) -> NDArray[np.float32]:
    """Returns the wall thickness of each face. Adds the cell arrays "thickness" and "least_thickness"."""
    return compute(dataset, **{**options, "measure": "thickness"}).fields["thickness"]  # type: ignore[arg-type]


def segment(dataset: Any, **options: Unpack[FunctionOptions]) -> NDArray[np.int32]:
    """Returns the part number of each face. Adds the cell arrays "sdf", "seed" and "segment"."""
    return compute(dataset, **{"segment": "parts", **options}).fields["segment"]  # type: ignore[arg-type]


def add_array(dataset: Any, name: str, values: NDArray[Any]) -> None:
    """Adds a cell array with a value per face. The cells of a vtkPolyData are vertices, then lines, then faces."""
    from vtkmodules.util.numpy_support import numpy_to_vtk

    before = dataset.GetNumberOfVerts() + dataset.GetNumberOfLines()
    if before > 0:
        nothing = np.nan if values.dtype.kind == "f" else -1 if values.dtype.kind == "i" else 0
        values = np.concatenate([np.full((before, *values.shape[1:]), nothing, values.dtype), values])
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    dataset.GetCellData().AddArray(array)

"""Filters for ParaView 5.11 and later: shape diameter, wall thickness and parts as cell arrays.

In ParaView, load this file: Tools, Manage Plugins, Load New. In pvpython, pvbatch and the Python Shell of ParaView:

    from asdf_vk.hosts import asdf_vk_paraview
    asdf_vk_paraview.load(globals())
    walls = WallThickness(Input=part, Limit=0.8)

The filters are in the menu Filters, asdf-vk. ParaView 5.11 imports a function that Python 3.11 has removed. This module
adds the function. Therefore, with Python 3.11, as in Debian 12, ParaView 5.11 can load Python plug-ins only after this
module was imported.

Input is a vtkPolyData. Convert other datasets with the filter Extract Surface. For scripts with VTK or PyVista,
asdf_vk.compat.vtk has functions with the same results.
"""

from __future__ import annotations

import inspect

try:
    import asdf_vk
    from asdf_vk.compat import vtk as cells
except ImportError as error:
    raise ImportError(
        f"the Python package asdf_vk cannot be imported ({error}); start ParaView with the folder that holds it in "
        "PYTHONPATH: PYTHONPATH=~/.local/lib/python3.11/site-packages paraview"
    ) from error

if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec  # ParaView 5.11 needs this function, which Python 3.11 has removed.

from paraview import print_error, print_warning
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

IN_MENU = '<ShowInMenu category="asdf-vk"/>'
YES_OR_NO = '<BooleanDomain name="bool"/>'


class SurfaceFilter(VTKPythonAlgorithmBase):
    """Base class of the filters: copies a surface and adds arrays. Options are keywords of asdf_vk.compute()."""

    def __init__(self, **options) -> None:
        super().__init__(nInputPorts=1, nOutputPorts=1, inputType="vtkPolyData", outputType="vtkPolyData")
        self.options = options

    def set_option(self, name: str, value) -> None:
        if self.options.get(name) != value:
            self.options[name] = value
            self.Modified()

    def describe(self, surface: vtkPolyData, info: asdf_vk.Info) -> None:
        """Adds further arrays."""

    def RequestData(self, request, inputs, outputs) -> int:
        surface = vtkPolyData.GetData(outputs, 0)
        surface.ShallowCopy(vtkPolyData.GetData(inputs[0], 0))

        def progress(fraction: float, stage: str) -> bool:
            self.UpdateProgress(fraction)
            return not self.GetAbortExecute()

        try:
            self.describe(surface, cells.compute(surface, progress=progress, **self.options))
        except asdf_vk.CancelledError:
            print_warning("asdf-vk: cancelled; the output has no new arrays")
        except asdf_vk.Error as error:
            print_error(f"asdf-vk: {error}")
            return 0
        return 1


@smproxy.filter(name="ShapeDiameter", label="Shape Diameter")
@smhint.xml(IN_MENU)
@smproperty.input(name="Input")
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
class ShapeDiameter(SurfaceFilter):
    """Adds the cell arrays sdf and seed. seed is 1 if rays started at the cell, else 0."""

    @smproperty.intvector(name="TraceAllFaces", label="Trace All Faces", default_values=0)
    @smdomain.xml(YES_OR_NO)
    def SetTraceAllFaces(self, value: int) -> None:
        self.set_option("seeds", "all" if value else None)


@smproxy.filter(name="WallThickness", label="Wall Thickness")
@smhint.xml(IN_MENU)
@smproperty.input(name="Input")
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
class WallThickness(SurfaceFilter):
    """Cell arrays: thickness at the barycentre, and least_thickness over all points of the cell. With a limit also the
    cell array thin, which is 1 where least_thickness is below the limit, and the field data verdict and
    least_thickness_of_part. Lengths have the unit of the points.
    """

    def __init__(self) -> None:
        super().__init__(measure="thickness")

    @smproperty.doublevector(name="Limit", label="Limit", default_values=0)
    def SetLimit(self, value: float) -> None:
        self.set_option("thinner_than", value or None)

    @smproperty.intvector(name="CountDetails", label="Count Details", default_values=0)
    @smdomain.xml(YES_OR_NO)
    def SetCountDetails(self, value: int) -> None:
        self.set_option("count_details", bool(value) or None)

    @smproperty.intvector(name="CountEdges", label="Count Edges", default_values=0)
    @smdomain.xml(YES_OR_NO)
    def SetCountEdges(self, value: int) -> None:
        self.set_option("count_edges", bool(value) or None)

    def describe(self, surface: vtkPolyData, info: asdf_vk.Info) -> None:
        if self.options.get("thinner_than") is None:
            return
        cells.add_array(surface, "thin", info.thin.astype("u1"))
        verdict, least = vtkStringArray(), vtkDoubleArray()
        verdict.SetName("verdict")
        verdict.InsertNextValue(info.thickness.verdict)
        least.SetName("least_thickness_of_part")
        least.InsertNextValue(info.thickness.min)
        for array in (verdict, least):
            surface.GetFieldData().AddArray(array)


@smproxy.filter(name="ShapeParts", label="Shape Parts")
@smhint.xml(IN_MENU)
@smproperty.input(name="Input")
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
class ShapeParts(SurfaceFilter):
    """Adds the cell arrays segment (number of the part, from 0), sdf and seed."""

    def __init__(self) -> None:
        super().__init__(segment="parts")

    @smproperty.intvector(name="NumberOfParts", label="Number Of Parts", default_values=0)
    @smdomain.intrange(min=0, max=100)
    def SetNumberOfParts(self, value: int) -> None:
        self.set_option("parts", value or None)


def load(names: dict | None = None) -> None:
    """Loads this file as a plug-in. names: globals() of a script that has imported paraview.simple."""
    from paraview.simple import LoadPlugin

    LoadPlugin(__file__, ns=names)

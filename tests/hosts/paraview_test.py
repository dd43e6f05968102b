"""Run by pvbatch: the filters on a part, compared with the command line; cancel; wrong inputs; a picture.

    pvbatch paraview_test.py FOLDER PICTURE     # FOLDER: part.ply, polygons.ply and the .npy of the command line
"""

import sys
from pathlib import Path

import numpy as np
from checks import Checks

import asdf_vk
from asdf_vk.compat import vtk as cells
from asdf_vk.hosts import asdf_vk_paraview
from paraview import servermanager
from paraview.simple import *  # noqa: F403
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

folder, picture = Path(sys.argv[1]), Path(sys.argv[2])
checks = Checks("ParaView")
asdf_vk_paraview.load(globals())


def arrays_of(proxy):
    """The cell arrays of a filter."""
    data = servermanager.Fetch(proxy).GetCellData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


part = PLYReader(FileNames=[str(folder / "part.ply")])
diameter = arrays_of(ShapeDiameter(Input=part))
checks.same_bits("sdf", diameter["sdf"], folder / "part.sdf.npy")
checks.that("all faces cast rays", bool(diameter["seed"].all()))
walls_filter = WallThickness(Input=part, Limit=0.8)
walls = arrays_of(walls_filter)
for name in ("thickness", "least_thickness"):
    checks.same_bits(name, walls[name], folder / f"part.{name}.npy")
checks.that("thin faces", (walls["thin"] == (walls["least_thickness"] < 0.8)).all() and walls["thin"].any())
facts = servermanager.Fetch(walls_filter).GetFieldData()
checks.that("verdict", facts.GetAbstractArray("verdict").GetValue(0) == "failed")
checks.that("least thickness", abs(facts.GetArray("least_thickness_of_part").GetValue(0) - 0.6) < 1e-6)
sheet = servermanager.Fetch(WallThickness(Input=Plane(), Limit=1))
checks.that("an open sheet is not judged", sheet.GetFieldData().GetAbstractArray("verdict").GetValue(0) == "notJudged")
plate = Box(XLength=10, YLength=10, ZLength=0.8, Center=[10.3, 10.3, 5.7])
limited = WallThickness(Input=Clean(Input=plate), Limit=0.8)
passes = servermanager.Fetch(limited).GetFieldData().GetAbstractArray("verdict").GetValue(0) == "passed"
checks.that("a wall of the limit is not thin", passes and not arrays_of(limited)["thin"].any())
figure = PLYReader(FileNames=[str(folder / "figure.ply")])
checks.same_bits("segment", arrays_of(ShapeParts(Input=figure))["segment"], folder / "figure.segment.npy")
three = arrays_of(ShapeParts(Input=figure, NumberOfParts=3))["segment"]
checks.that("three parts", sorted(set(three.tolist())) == [0, 1, 2])

# Functions for scripts: polygons, other cells, options.
polygons = asdf_vk.read_mesh(folder / "polygons.ply")
surface = vtkPolyData()
corners, sizes = np.load(folder / "polygons.corners.npy"), np.load(folder / "polygons.sizes.npy")
points, faces, lines = vtkPoints(), vtkCellArray(), vtkCellArray()
points.SetDataTypeToDouble()
for vertex in polygons.vertices:
    points.InsertNextPoint(vertex)
for face in np.split(corners, np.cumsum(sizes)[:-1]):
    faces.InsertNextCell(len(face), face.tolist())
lines.InsertNextCell(2, [0, 1])
surface.SetPoints(points)
surface.SetPolys(faces)
surface.SetLines(lines)
checks.same_bits("polygons", cells.thickness(surface), folder / "polygons.thickness.npy")
stored = vtk_to_numpy(surface.GetCellData().GetArray("thickness"))
checks.that("a line has no value", len(stored) == len(sizes) + 1 and bool(np.isnan(stored[0])))
checks.raises("no faces", asdf_vk.InputError, lambda: cells.thickness(vtkPolyData()), "extract its surface")
pointless = vtkPolyData()
pointless.SetPolys(faces)
checks.raises("faces without points", asdf_vk.InputError, lambda: cells.thickness(pointless), "no faces")
checks.raises("an array instead of a dataset", asdf_vk.InputError, lambda: cells.segment(np.zeros((3, 3))), "vtkPolyData")

# Cancel: what the button "Abort" does.
big = PLYReader(FileNames=[str(folder / "big.ply")])
cancelled = ShapeDiameter(Input=big, TraceAllFaces=1)
algorithm = cancelled.GetClientSideObject()
seen = []


def abort(caller, event):
    seen.append(caller.GetProgress())
    if caller.GetProgress() > 0.05:
        caller.SetAbortExecute(1)


observer = algorithm.AddObserver("ProgressEvent", abort)
names = set(arrays_of(cancelled))
checks.that("cancelled: no arrays", "sdf" not in names and any(0.05 < fraction < 0.9 for fraction in seen))
algorithm.RemoveObserver(observer)
algorithm.SetAbortExecute(0)
algorithm.Modified()
checks.that("computed again after cancelling", "sdf" in arrays_of(cancelled))

# The picture: the thin walls of the part.
view = CreateView("RenderView")
view.ViewSize = [1000, 640]
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
view.OrientationAxesVisibility = 0
shown = Show(walls_filter, view)
ColorBy(shown, ("CELLS", "least_thickness"))
shown.Ambient, shown.Diffuse = 0.35, 0.7
table = GetColorTransferFunction("least_thickness")
table.ApplyPreset("Viridis (matplotlib)", True)
table.RescaleTransferFunction(0.6, 4)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(table, view)
bar.Title, bar.ComponentTitle, bar.RangeLabelFormat = "least_thickness", "", "%.1f"
bar.WindowLocation = "Upper Right Corner"
bar.TitleColor = bar.LabelColor = [0, 0, 0]
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [34, -16, 22], [0, 0, 0], [0, 0, 1]
ResetCamera(view)
GetActiveCamera().Zoom(1.25)
SaveScreenshot(str(picture), view, ImageResolution=[1000, 640], CompressionLevel="9")
checks.picture(picture)
checks.finish()

"""Run by freecadcmd: the check of solids and meshes, compared with the command line; cancel; wrong objects."""

import os
import subprocess
import sys
from pathlib import Path

import FreeCAD
import Mesh
import numpy as np
import Part
from checks import Checks
from polygons import write_ply

import asdf_vk
from asdf_vk.hosts import asdf_vk_freecad as host

folder = Path.cwd()
checks = Checks("FreeCAD")
document = FreeCAD.newDocument()
vector = FreeCAD.Vector


def computed(obj, field):
    """The values of the command line for the triangles of an object."""
    points, faces = host.triangles_of(obj, 0.05)
    write_ply(str(folder / "freecad.ply"), points, faces.tolist())
    path = folder / f"freecad.{field}.npy"
    command = [os.environ["ASDF_VK_PROGRAM"], folder / "freecad.ply", "--measure", "thickness", "--fields", field, "-o", path]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return path


def add(shape, label):
    obj = document.addObject("Part::Feature", "Solid")
    obj.Shape, obj.Label = shape, label
    return obj


def mesh_of(name):
    """FreeCAD 0.20 misreads PLY files whose faces have further properties."""
    read = asdf_vk.read_mesh(folder / name)
    return Mesh.Mesh(read.vertices[read.faces].tolist())


# A cup of 2 mm with a hole 0.6 mm beside its outer wall: known thickness.
hole = Part.makeCylinder(0.3, 44, vector(-1, 1.1, 10), vector(1, 0, 0))
cup = Part.makeBox(40, 30, 20).cut(Part.makeBox(36, 26, 18, vector(2, 2, 2))).cut(hole)
cup.translate(vector(100, 0, 0))
obj = add(cup, "Cup")
reports = []
info = host.check(obj, 0.75, progress=lambda fraction, stage: reports.append(fraction))
report = info.thickness
# Between the hole and the outside: 1.1 - 0.3 = 0.8; and 2 - 1.1 - 0.3 = 0.6 to the inside.
checks.that(f"verdict {report.verdict}, least {report.min}", report.verdict == "failed" and abs(report.min - 0.6) < 0.02)
checks.that(f"progress {reports}", len(reports) > 0 and reports[-1] == 1)
group = document.getObjectsByLabel("Thickness of Cup")[0]
mesh, places = group.Group[0], group.Group[1:]
checks.that("verdict of the group", group.Verdict == "FAIL" and abs(group.LeastThickness.Value - report.min) < 1e-9)
points, faces = mesh.Mesh.Topology
vertices, triangles = host.triangles_of(obj, 0.05)
places_of_faces = np.array([tuple(p) for p in points])[np.array(faces)]
checks.that("the mesh in the document", abs(places_of_faces - vertices[triangles]).max() < 1e-4)
checks.that(f"volume {mesh.Mesh.Volume}", abs(mesh.Mesh.Volume / cup.Volume - 1) < 1e-3 and mesh.Mesh.isSolid())
checks.that("a value and a colour per face", mesh.Mesh.CountFacets == len(info.fields["thickness"]) == len(mesh.FaceColors))
checks.same_bits("least_thickness", info.fields["least_thickness"], computed(obj, "least_thickness"))
checks.same_bits("thickness", info.fields["thickness"], computed(obj, "thickness"))
checks.same_bits("values in the document", np.array(mesh.LeastThickness, np.float32), folder / "freecad.least_thickness.npy")
reds = [colour[:2] == (0.85, 0.1) or (colour[0] > 0.8 and colour[1] < 0.2) for colour in mesh.FaceColors]
checks.that("thin faces are red", reds == (info.fields["least_thickness"] < 0.75).tolist() and any(reds))
checks.that("a place per region", len(places) == len(report.regions) > 0)
line = places[0].Shape
checks.that("the place is a line through the wall", abs(line.Length - report.min) < 1e-6 and line.BoundBox.XMin >= 100)
checks.that(f"its label {places[0].Label!r}", places[0].Label.startswith("wall 0.6"))
count = len(document.Objects)
again = host.check(obj, 0.5)
passes = again.thickness.verdict == "passed"
checks.that("another limit passes, and replaces the result", passes and len(document.Objects) < count)

# Placements, of the object and of the part around it; a mesh object has the values of the solid.
box = add(Part.makeBox(10, 10, 1), "Plate")
box.Placement = FreeCAD.Placement(vector(5, 6, 7), FreeCAD.Rotation(vector(1, 2, 3), 40))
container = document.addObject("App::Part", "Assembly")
container.Placement = FreeCAD.Placement(vector(0, 0, 50), FreeCAD.Rotation(vector(0, 1, 0), 90))
container.addObject(box)
info = host.check(box, 2)
checks.that("the plate is 1 mm", abs(info.thickness.min - 1) < 1e-5)
center = document.getObjectsByLabel("Thickness of Plate")[0].Group[0].Mesh.BoundBox.Center
expected = container.Placement.multiply(box.Placement).multVec(vector(5, 5, 0.5))
checks.that("the result is at the place of the plate", center.distanceToPoint(expected) < 1e-3)
feature = document.addObject("Mesh::Feature", "Part")
feature.Mesh = mesh_of("part.ply")
feature.Placement = FreeCAD.Placement(vector(1000, 0, 0), FreeCAD.Rotation())
info = host.check(feature, 0.8)
checks.that(f"a mesh: {info.thickness.min}", info.thickness.verdict == "failed" and abs(info.thickness.min - 0.6) < 1e-4)
checks.that("at its place", info.thickness.min_place[0] > 900)
# Solids that touch are measured on their own.
pair = Part.makeCompound([Part.makeBox(10, 10, 1), Part.makeBox(10, 10, 1, vector(0, 0, 1))])
checks.that("two plates", abs(host.check(add(pair, "Pair"), 2).thickness.min - 1) < 1e-6)
knife = Part.makePolygon([vector(0, 0, 0), vector(10, 0, 0), vector(10, 0, 3), vector(0, 0, 0)])
wedge = add(Part.Face(knife).extrude(vector(0, 5, 0)), "Wedge")
report = host.check(wedge, 0.5).thickness  # 16.7 degrees.
checks.that("a narrow wedge fails", report.verdict == "failed" and [r.kind for r in report.regions] == ["wall"])
wide = Part.makePolygon([vector(0, 0, 0), vector(10, 0, 0), vector(10, 0, 4), vector(0, 0, 0)])
wedge = add(Part.Face(wide).extrude(vector(0, 5, 0)), "Wide wedge")  # 21.8 degrees.
report = host.check(wedge, 0.5).thickness
checks.that("a wide one has an edge", report.verdict == "passed" and [r.kind for r in report.regions] == ["edge"])
checks.that("which can count", host.check(wedge, 0.5, count_edges=True).thickness.verdict == "failed")

limited = add(Part.makeBox(10, 10, 0.8, vector(5.3, 5.3, 5.3)), "Limited")
checks.that("a wall of the limit passes", host.check(limited, 0.8).thickness.verdict == "passed")
result = host.result_of(limited).Group[0]
checks.that("and nothing is red", len(set(result.FaceColors)) > 0 and not any(c[0] > 0.8 and c[1] < 0.2 for c in result.FaceColors))
checks.that(f"its label {result.Label!r}", result.Label.startswith("Limited: PASS"))
host.check(limited, 0.802)
label = host.result_of(limited).Group[1].Label
checks.that(f"a wall just below it {label!r}", label.startswith("wall 0.8 mm at ("))
both = add(Part.makeCompound([Part.makeBox(10, 10, 5), Part.makePlane(10, 10, vector(20, 0, 0))]), "Both")
checks.that("a face beside a solid is not left out", host.check(both, 1).thickness.verdict == "notJudged")
other = document.addObject("App::FeaturePython", "Other")
other.Label = "Thickness of Named"
named = add(Part.makeBox(10, 10, 1), "Named")
host.check(named, 2)
host.check(named, 2)
results = [o for o in document.Objects if getattr(o, "CheckedObject", None) == named.Name]
checks.that("an object with the label of the result", len(results) == 1 and other in document.Objects)

sheet = add(Part.makePlane(10, 10), "Sheet")
checks.that("an open sheet is not judged", host.check(sheet, 1).thickness.verdict == "notJudged")
checks.that("and in the document", document.getObjectsByLabel("Thickness of Sheet")[0].Verdict == "NOT JUDGED")

# Wrong objects, cancel: one line, and the document is unchanged.
count = len(document.Objects)
empty = document.addObject("App::DocumentObjectGroup", "Empty")
checks.raises("no faces", ValueError, lambda: host.check(empty, 1), "has no faces")
link = document.addObject("App::Link", "Link")
link.LinkedObject = box
checks.raises("a link", ValueError, lambda: host.check(link, 1), "has no faces")
checks.raises("an empty mesh", ValueError, lambda: host.check(document.addObject("Mesh::Feature"), 1), "has no faces")
count = len(document.Objects) - 1
checks.raises("limit 0", ValueError, lambda: host.check(box, 0), "above 0 mm")
big = document.addObject("Mesh::Feature", "Big")
big.Mesh = mesh_of("big.ply")
fractions = []

def below_a_tenth(fraction, stage):
    fractions.append(fraction)
    return fraction < 0.1


checks.raises("cancel", asdf_vk.CancelledError, lambda: host.check(big, 0.01, progress=below_a_tenth), "")
checks.that("in the middle, without a result", 0 < fractions[-1] < 0.9 and len(document.Objects) == count + 2)
document.saveAs(str(folder / "freecad.FCStd"))
checks.that("the document is stored", (folder / "freecad.FCStd").stat().st_size > 1000)

path, sys.path[:] = list(sys.path), [p for p in sys.path if not os.path.isdir(os.path.join(p, "asdf_vk"))]
for name in [name for name in sys.modules if name.split(".")[0] == "asdf_vk" and "hosts" not in name]:
    del sys.modules[name]
checks.raises("no package", ImportError, lambda: host.check(box, 1), "-P FOLDER")
checks.finish()

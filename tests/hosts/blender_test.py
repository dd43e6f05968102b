"""Run by blender -b: the add-on on meshes of every kind, compared with the command line; cancel; wrong objects.

    blender -b --factory-startup --python blender_test.py -- FOLDER
"""

import os
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
from checks import Checks
from mathutils import Matrix
from polygons import shape, write_ply

folder = Path(sys.argv[sys.argv.index("--") + 1])
program = os.environ["ASDF_VK_PROGRAM"]
checks = Checks("Blender")

import asdf_vk  # noqa: E402

addon = os.path.join(os.path.dirname(asdf_vk.__file__), "hosts", "asdf_vk_blender.py")
bpy.ops.preferences.addon_install(filepath=addon)
bpy.ops.preferences.addon_enable(module="asdf_vk_blender")
addons = sys.modules["asdf_vk_blender"]


def add(name, vertices, faces, matrix=None):
    """A new object, which is active."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(vertex) for vertex in vertices], [], [tuple(face) for face in faces])
    obj = bpy.data.objects.new(name, mesh)
    obj.matrix_world = matrix or Matrix.Identity(4)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    bpy.context.view_layer.update()
    return obj


def attribute(obj, name):
    data = obj.data.attributes[name]
    is_real = data.data_type == "FLOAT"
    values = np.empty(len(obj.data.polygons), np.float32 if is_real else np.int32)
    data.data.foreach_get("value", values)
    checks.that(f"{name} is an attribute of faces", data.domain == "FACE" and len(data.data) == len(values))
    return values


def computed(obj, name, *options):
    """The values of the command line for the object, written by code of the test: in the world, in double."""
    world = [[sum(row[i] * x for i, x in enumerate((*vertex.co, 1.0))) for row in obj.matrix_world][:3]
             for vertex in obj.data.vertices]  # fmt: skip
    faces = [list(polygon.vertices) for polygon in obj.data.polygons]
    if obj.matrix_world.determinant() < 0:
        faces = [[face[0], *face[:0:-1]] for face in faces]
    write_ply(str(folder / "blender.ply"), np.array(world), faces)
    path = folder / f"blender.{name}.npy"
    command = [program, folder / "blender.ply", *options, "--fields", name, "-o", path]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return path


def selected(obj):
    return [i for i, polygon in enumerate(obj.data.polygons) if polygon.select]


part = asdf_vk.read_mesh(folder / "part.ply")
obj = add("part", part.vertices, part.faces)
checks.that("finished", bpy.ops.object.asdf_vk(measure="THICKNESS", limit=0.8) == {"FINISHED"})
for name in ("thickness", "least_thickness"):
    checks.same_bits(name, attribute(obj, name), computed(obj, name, "--measure", "thickness"))
least = attribute(obj, "least_thickness")
checks.that("thin faces are selected", selected(obj) == np.flatnonzero(least < 0.8).tolist() and selected(obj))
corners_selected = {v for i in selected(obj) for v in obj.data.polygons[i].vertices}
checks.that("and their vertices", {v.index for v in obj.data.vertices if v.select} == corners_selected)
checks.that(f"report {obj.data['asdf_vk_report']!r}", obj.data["asdf_vk_report"].startswith("FAIL, least wall 60 cm; 28 faces below 80 cm"))
colours = np.array([item.color for item in obj.data.color_attributes["asdf-vk"].data]).reshape(-1, 3, 4)
reds = (colours[:, 0, 0] > 0.6) & (colours[:, 0, 1] < 0.1) & (colours[:, 0, 2] < 0.1)
checks.that("thin faces are red, and no others", (reds == (least < 0.8)).all())
checks.that("the colours are active", obj.data.color_attributes.active_color.name == "asdf-vk")
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.object.mode_set(mode="OBJECT")
checks.that("the selection survives Edit Mode", selected(obj) == np.flatnonzero(least < 0.8).tolist())
bpy.ops.object.asdf_vk(measure="THICKNESS", limit=0.5)
checks.that("passes", obj.data["asdf_vk_report"].startswith("PASS") and not selected(obj))

bpy.ops.object.asdf_vk(measure="DIAMETER")
checks.same_bits("sdf", attribute(obj, "sdf"), computed(obj, "sdf"))
checks.that("values stay when another is computed", "thickness" in obj.data.attributes)

vertices, faces = shape()
for name, matrix in (
    ("identity", Matrix.Identity(4)),
    ("scaled and turned", Matrix.Translation((5, -3, 2)) @ Matrix.Rotation(0.7, 4, (1, 2, 3)) @ Matrix.Diagonal((2, 0.5, 3, 1))),
    ("mirrored", Matrix.Diagonal((-1, 1, 1, 1))),
):
    obj = add(name, vertices, faces, matrix)
    bpy.ops.object.asdf_vk(measure="THICKNESS")
    path = computed(obj, "thickness", "--measure", "thickness")
    checks.same_bits(f"polygons, {name}", attribute(obj, "thickness"), path)
    checks.that(f"{name}: walls have values", np.isfinite(np.load(path)).sum() >= len(faces) - 1)

obj = add("mirrored and open", vertices, faces[:-1], Matrix.Diagonal((-1, 1, 1, 1)))
bpy.ops.object.asdf_vk(measure="THICKNESS", limit=0.01)
checks.that("a mirrored open mesh has no verdict", obj.data["asdf_vk_report"].startswith("NOT JUDGED"))

# A wall of the limit, but for rounding to float32.
box = [(x + 5.3, y + 5.3, z + 5.3) for x in (0, 10) for y in (0, 10) for z in (0, 0.8)]
sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
obj = add("plate at the limit", box, sides)
for limit, verdict, faces in ((0.8, "PASS", "0 faces below 80 cm"), (0.802, "FAIL, least wall 80 cm", "6 faces below 80.2 cm")):
    bpy.ops.object.asdf_vk(measure="THICKNESS", limit=limit)
    text = obj.data["asdf_vk_report"]
    checks.that(f"{text!r}", text.startswith(verdict) and text.endswith(faces))
checks.that("all are selected", len(selected(obj)) == 6)
bpy.ops.object.asdf_vk(measure="THICKNESS", limit=0.8)
checks.that("none is selected", not selected(obj))
obj.vertex_groups.new(name="sdf")
checks.raises("a name in use", RuntimeError, lambda: bpy.ops.object.asdf_vk(), "rename it")
obj = add("plate with an attribute", box, sides)
obj.data.attributes.new("sdf", "FLOAT", "POINT")
checks.raises("an attribute of the vertices", RuntimeError, lambda: bpy.ops.object.asdf_vk(), "rename it")

figure = asdf_vk.read_mesh(folder / "figure.ply")
obj = add("figure", figure.vertices, figure.faces)
own = [bpy.data.materials.new(name) for name in ("own 0", "own 1")]
for material in own:
    obj.data.materials.append(material)
obj.data.polygons.foreach_set("material_index", [i % 2 for i in range(len(figure.faces))])
bpy.ops.object.asdf_vk(measure="PARTS")
segments = attribute(obj, "segment")
checks.same_bits("segment", segments.astype(np.uint32), computed(obj, "segment", "--segment"))
names = ["own 0", "own 1", *(f"asdf-vk part {i}" for i in range(segments.max() + 1))]
checks.that("a material per part", [m.name for m in obj.data.materials] == names)
checks.that("material of each face", [p.material_index for p in obj.data.polygons] == (2 + segments).tolist())
colours = {tuple(round(c, 4) for c in m.diffuse_color) for m in list(obj.data.materials)[2:]}
checks.that("the colours of the parts differ", len(colours) == segments.max() + 1 > 3)
bpy.ops.object.asdf_vk(measure="PARTS", parts=3)
checks.that("three parts", len(obj.data.materials) == 5 and len(set(attribute(obj, "segment"))) == 3)
bpy.ops.object.asdf_vk_remove_parts()
checks.that("the own materials are back", [m.name for m in obj.data.materials] == names[:2])
checks.that("on their faces", [p.material_index for p in obj.data.polygons] == [i % 2 for i in range(len(figure.faces))])
checks.that("no parts remain", "segment" not in obj.data.attributes and "asdf_vk_material" not in obj.data.attributes)

# Wrong objects: one line each, and nothing changes.
empty = add("empty", [(0, 0, 0)], [])
checks.raises("no faces", RuntimeError, lambda: bpy.ops.object.asdf_vk(), "empty has no faces")
plane = add("plane", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])
bpy.ops.object.asdf_vk(measure="DIAMETER")
checks.that("an open sheet has no value", np.isnan(attribute(plane, "sdf")).all())
checks.that("and the report says so", "faces without a value: 1" in plane.data["asdf_vk_report"])
bpy.ops.object.asdf_vk(measure="THICKNESS", limit=1)
checks.that(f"nor a verdict: {plane.data['asdf_vk_report']!r}", plane.data["asdf_vk_report"].startswith("NOT JUDGED"))
bpy.ops.object.mode_set(mode="EDIT")
checks.raises("Edit Mode", RuntimeError, lambda: bpy.ops.object.asdf_vk(), "Object Mode")
bpy.ops.object.mode_set(mode="OBJECT")

# Cancel: the thread of the operator.
big = asdf_vk.read_mesh(folder / "big.ply")
computation = addons.Computation(asdf_vk, big, {"seeds": "all"})
computation.start()
while computation.fraction < 0.02 and computation.is_alive():
    pass
computation.is_cancelled = True
computation.join(20)
checks.that("cancelled", isinstance(computation.error, asdf_vk.CancelledError) and computation.info is None)
checks.that("in the middle", 0.02 <= computation.fraction < 0.9)

# Without the package: one sentence with what to do.
path, sys.path[:] = list(sys.path), [p for p in sys.path if not os.path.isdir(os.path.join(p, "asdf_vk"))]
for name in [name for name in sys.modules if name.split(".")[0] == "asdf_vk"]:
    del sys.modules[name]
bpy.context.view_layer.objects.active = obj
checks.raises("no package", RuntimeError, lambda: bpy.ops.object.asdf_vk(), "preferences of this add-on")
bpy.context.preferences.addons["asdf_vk_blender"].preferences.folder = os.environ["PYTHONPATH"].split(":")[0]
checks.that("the folder of the preferences", addons.module().__file__.startswith(os.environ["PYTHONPATH"].split(":")[0]))

bpy.ops.preferences.addon_disable(module="asdf_vk_blender")
checks.that("unregistered", not hasattr(bpy.types.Scene, "asdf_vk"))
checks.finish()
